//! The tracker as the loop sees it: behind a fault if one is planted on it, on its trajectory or on its controls.

use super::{Fault, Planted};
use crate::trace::Controls;
use crate::tracker::{Tracker, TrackerConfig};
use corridor_decider::decision::TrajectoryPoint;
use corridor_decider::frame::EgoState;
use corridor_decider::vehicle::VehicleParams;

/// A tracker and the fault on it.
#[derive(Debug)]
pub(crate) struct Following {
    tracker: Tracker,
    planted: Planted,
    /// What the fault made of this tick's trajectory.
    followed: Option<Vec<TrajectoryPoint>>,
}

impl Following {
    /// A tracker for one car, behind a fault.
    pub(crate) fn new(mut vehicle: VehicleParams, mut config: TrackerConfig, fault: Fault) -> Self {
        let planted = Planted::new(fault);
        planted.tracker(&mut vehicle, &mut config);
        Self {
            tracker: Tracker::new(vehicle, config),
            planted,
            followed: None,
        }
    }

    /// Controls for the ego as it is now, `time_since_frame` seconds after the trajectory's time 0; to be asked for at
    /// that time first.
    pub(crate) fn track(
        &mut self,
        ego: &EgoState,
        trajectory: &[TrajectoryPoint],
        time_since_frame: f64,
    ) -> Controls {
        if time_since_frame <= 0.0 {
            self.followed = self.planted.followed(trajectory);
        }
        let followed = self.followed.as_deref().unwrap_or(trajectory);
        let controls = self.tracker.track(ego, followed, time_since_frame);
        self.planted.controls(controls)
    }
}
