//! The first moment: everyone on the road, nobody in anybody.

use super::{Rejection, Scene};
use corridor_decider::geometry::ConvexPolygon;
use corridor_decider::reference_line::LineQuery;

/// How far the ego's corners may be off the road at the start, m: below the 0.3 m that a run may use.
const EGO_OFF_ROAD: f64 = 0.1;

/// How far beside the road an obstacle may be, m: a pavement and a front garden.
const BESIDE_ROAD: f64 = 10.0;

pub(super) fn check(scene: &Scene<'_>) -> Result<(), Rejection> {
    on_the_map(scene)?;
    ego_on_road(scene)?;
    no_overlap(scene)
}

fn on_the_map(scene: &Scene<'_>) -> Result<(), Rejection> {
    let line = &scene.road.line;
    let own = scene.draft.first_of_map;
    for (obstacle, spot) in scene.draft.obstacles.iter().zip(&scene.draft.spots).take(own) {
        let beside = line
            .road_width(spot.s)
            .is_some_and(|(left, right)| spot.l < left + BESIDE_ROAD && spot.l > -right - BESIDE_ROAD);
        if !beside {
            return Err(Rejection::OffMap {
                obstacle: obstacle.name.clone(),
                s: spot.s,
            });
        }
    }
    Ok(())
}

fn ego_on_road(scene: &Scene<'_>) -> Result<(), Rejection> {
    let body = scene.draft.vehicle.footprint(scene.draft.ego.pose);
    let off_road = body
        .vertices()
        .iter()
        .map(|corner| scene.road.map.distance_off_road(*corner));
    let distance = off_road.fold(0.0, f64::max);
    if distance > EGO_OFF_ROAD {
        return Err(Rejection::EgoOffRoad { distance });
    }
    Ok(())
}

/// A body with a circle around its centre, which tells most pairs apart.
struct Body<'a> {
    name: &'a str,
    ground: ConvexPolygon,
    radius: f64,
}

impl<'a> Body<'a> {
    fn new(name: &'a str, ground: ConvexPolygon) -> Self {
        let centre = ground.vertices()[0];
        let radius = ground
            .vertices()
            .iter()
            .map(|v| (v - centre).norm())
            .fold(0.0, f64::max);
        Self { name, ground, radius }
    }

    fn overlaps(&self, other: &Self) -> bool {
        let apart = (self.ground.vertices()[0] - other.ground.vertices()[0]).norm();
        apart < self.radius + other.radius && self.ground.overlaps(&other.ground)
    }
}

fn no_overlap(scene: &Scene<'_>) -> Result<(), Rejection> {
    let draft = scene.draft;
    let mut bodies = vec![Body::new("ego", draft.vehicle.footprint(draft.ego.pose))];
    for (k, (obstacle, spot)) in draft.obstacles.iter().zip(&draft.spots).enumerate() {
        let next = Body::new(&obstacle.name, obstacle.shape.at(spot.pose(scene.road)));
        if let Some(hit) = bodies.iter().find(|body| body.overlaps(&next)) {
            return Err(Rejection::Overlap {
                first: hit.name.to_owned(),
                second: next.name.to_owned(),
            });
        }
        // The parts of a fence may be in each other.
        if k < draft.first_of_map {
            bodies.push(next);
        }
    }
    Ok(())
}
