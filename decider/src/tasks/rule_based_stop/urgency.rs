//! A stop well before the end of a lane that must be left, while the lane to change to is not free
//! (`CheckLaneChangeUrgency`): nearer to its end there is no room left to change in.

use crate::decision::{Stop, StopCause};
use crate::reference_line::LineQuery;
use crate::tasks::lane_change::target_line;
use crate::tasks::path::Path;
use crate::tasks::scene::Scene;

/// Where to wait. The own line is planned along only while the other one cannot be.
pub(super) fn stop(scene: &Scene, path: &Path) -> Option<Stop> {
    let config = &scene.config.rule_based_stop;
    let must_change = !scene.is_change_lane && target_line(scene.frame).is_some();
    let end = scene.line.length();
    let is_near = end - scene.ego_end_s() <= config.approach_distance_for_lane_change;
    if !config.enable_lane_change_urgency_check || !must_change || !is_near {
        return None;
    }
    let s = end - config.urgent_distance_for_lane_change - scene.vehicle.front_edge_to_center;
    Some(Stop {
        distance: path.distance_at(s).max(0.0),
        cause: StopCause::LaneChangeUrgency,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::FrameLine;
    use crate::tasks::testing::{EGO_S, Stage, straight_path};

    /// Distance to the wall on an own lane of this length beside which there is another one.
    fn wall(length: f64, is_asked_for: bool) -> Option<f64> {
        let mut stage = Stage::new(length, f64::MAX);
        stage.config.rule_based_stop.enable_lane_change_urgency_check = is_asked_for;
        let target = FrameLine {
            is_change_lane: true,
            ..stage.frame.lines[0].clone()
        };
        stage.frame.lines.push(target);
        let path = straight_path(60);
        stop(&stage.scene(), &path).map(|stop| stop.distance)
    }

    #[test]
    fn the_car_waits_fifty_metres_before_the_end_of_its_lane() {
        let front = crate::vehicle::VehicleParams::default().front_edge_to_center;
        assert_eq!(wall(EGO_S + front + 81.0, true), None, "still far");
        let near = wall(EGO_S + front + 79.0, true).unwrap();
        assert!((near - 29.0).abs() < 0.51, "{near}");
        assert_eq!(wall(EGO_S + front + 30.0, true), Some(0.0), "too late: at once");
        assert_eq!(wall(EGO_S + front + 79.0, false), None);
    }

    #[test]
    fn without_another_lane_there_is_nothing_to_wait_for() {
        let mut stage = Stage::new(60.0, f64::MAX);
        stage.config.rule_based_stop.enable_lane_change_urgency_check = true;
        assert_eq!(stop(&stage.scene(), &straight_path(30)), None);
    }
}
