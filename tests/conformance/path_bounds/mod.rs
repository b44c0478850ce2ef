//! Cases of the path-bounds decider: from their JSON to a call, and from its answer to a verdict.

mod call;
mod case;
mod compare;

pub(crate) use case::PathBoundsCase;

use corridor_decider::geometry::Vec2;
use corridor_decider::tasks::path_bounds as bounds;

/// Runs a case with the original's defects and compares everything that it names.
pub(crate) fn check(case: &PathBoundsCase) -> Result<(), String> {
    let input = &case.input;
    let config = call::config(input)?;
    let vehicle = call::vehicle(&input.vehicle);
    let (obstacles, names) = call::obstacles(&input.obstacles);
    let mut memory = call::memory(&input.status);
    let borrow = call::borrow(input);
    let question = bounds::Input {
        ego: call::ego(input, &config, &vehicle),
        ego_end_s: input.adc_sl_boundary.end_s,
        obstacles: &obstacles,
        config: &config,
        vehicle: &vehicle,
        cruise_speed: input.reference_line_info.cruise_speed,
        is_change_lane: input.reference_line_info.is_change_lane_path,
        path_reusable: input.reference_line_info.path_reusable,
        borrow: &borrow,
        destination: Some(Vec2::new(input.routing_end.x, input.routing_end.y)),
    };
    let answer = bounds::decide(&input.world, &question, &mut memory);
    compare::compare(case, answer, &memory, &names)
}
