//! A straight road made of sections and one call of the decider along it.

use crate::frame::ObstacleId;
use crate::geometry::{Pose, Vec2, angle};
use crate::reference_line::{LinePoint, LineQuery, SlPoint};
use crate::road::{BoundaryType, Neighbour, Side};
use crate::tasks::path_bounds::{
    self, Borrow, EgoFrenet, Input, Label, LaneType, Memory, ObstacleSl, PathBound, PathBounds,
    PathBoundsConfig, PathBoundsError, PullOverKind, Quirks,
};
use crate::vehicle::VehicleParams;

/// What the road is like from one station on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Section {
    pub from: f64,
    pub lane: Option<(f64, f64)>,
    pub road: Option<(f64, f64)>,
    pub offset: Option<f64>,
    pub marks: Option<(BoundaryType, BoundaryType)>,
    /// Indexed by [`Neighbour::index`].
    pub neighbours: [Option<f64>; 4],
    pub junction: bool,
}

/// A lane of 3.5 m inside a wider road, dotted lines, no neighbours.
pub(super) const PLAIN: Section = Section {
    from: f64::NEG_INFINITY,
    lane: Some((1.75, 1.75)),
    road: Some((5.25, 3.0)),
    offset: Some(0.0),
    marks: Some((BoundaryType::DottedWhite, BoundaryType::DottedWhite)),
    neighbours: [None; 4],
    junction: false,
};

/// A straight line through sections.
#[derive(Clone, Debug)]
pub(super) struct Road {
    pub origin: Pose,
    pub length: f64,
    /// By ascending `from`, the first from minus infinity.
    pub sections: Vec<Section>,
}

impl Road {
    fn at(&self, s: f64) -> &Section {
        let past = self.sections.partition_point(|section| section.from <= s);
        &self.sections[past.saturating_sub(1)]
    }

    fn inside(&self, s: f64) -> bool {
        s >= 0.0 && s <= self.length
    }
}

impl LineQuery for Road {
    fn length(&self) -> f64 {
        self.length
    }

    fn lane_width(&self, s: f64) -> Option<(f64, f64)> {
        self.at(s).lane.filter(|_| self.inside(s))
    }

    fn road_width(&self, s: f64) -> Option<(f64, f64)> {
        self.at(s).road.filter(|_| self.inside(s))
    }

    fn offset_to_map(&self, s: f64) -> Option<f64> {
        self.at(s).offset
    }

    fn boundary_types(&self, s: f64) -> Option<(BoundaryType, BoundaryType)> {
        self.at(s).marks
    }

    fn neighbour_width(&self, neighbour: Neighbour, s: f64) -> Option<f64> {
        self.at(s).neighbours[neighbour.index()]
    }

    fn near_junction(&self, s: f64, radius: f64) -> bool {
        let end = |k: usize| self.sections.get(k + 1).map_or(f64::INFINITY, |next| next.from);
        (self.sections.iter().enumerate())
            .any(|(k, it)| it.junction && it.from <= s + radius && s - radius <= end(k))
    }

    fn lane_heading(&self, _point: Vec2, _theta: f64) -> Option<f64> {
        None
    }

    fn point(&self, s: f64) -> LinePoint {
        let at = self.origin.advanced(s.clamp(0.0, self.length));
        LinePoint {
            x: at.x,
            y: at.y,
            theta: angle::wrap(at.theta),
            kappa: 0.0,
        }
    }

    fn to_frenet(&self, point: Vec2) -> SlPoint {
        let local = self.origin.to_local(point);
        SlPoint {
            s: local.x,
            l: local.y,
        }
    }
}

/// One call of the decider. Starts as the worked examples do: 50 m into 230 m of [`PLAIN`] road, standing on
/// the line.
#[derive(Clone, Debug)]
pub(super) struct Setup {
    pub road: Road,
    pub ego: EgoFrenet,
    pub obstacles: Vec<ObstacleSl>,
    pub config: PathBoundsConfig,
    pub vehicle: VehicleParams,
    pub borrow: Vec<Borrow>,
    pub is_change_lane: bool,
    pub destination: Option<Vec2>,
    pub cruise_speed: f64,
    pub memory: Memory,
}

impl Setup {
    pub(super) fn new(config: PathBoundsConfig) -> Self {
        Self {
            road: Road {
                origin: Pose::new(0.0, 0.0, 0.0),
                length: 230.0,
                sections: vec![PLAIN],
            },
            ego: EgoFrenet {
                s: 50.0,
                s_dot: 0.0,
                l: 0.0,
                l_dot: 0.0,
            },
            obstacles: Vec::new(),
            config,
            vehicle: VehicleParams::default(),
            borrow: Vec::new(),
            is_change_lane: false,
            destination: None,
            cruise_speed: 0.0,
            memory: Memory::default(),
        }
    }

    pub(super) fn fixed() -> Self {
        Self::new(PathBoundsConfig::default())
    }

    pub(super) fn apollo() -> Self {
        Self::new(PathBoundsConfig::apollo())
    }

    /// The same call twice: with the mended default and with one quirk.
    pub(super) fn without_and_with(self, quirk: impl FnOnce(&mut Quirks)) -> (Self, Self) {
        let mut on = self.clone();
        quirk(&mut on.config.quirks);
        assert_ne!(on.config.quirks, self.config.quirks, "the quirk is on already");
        (self, on)
    }

    pub(super) fn parked(mut self, id: u32, s: (f64, f64), l: (f64, f64)) -> Self {
        self.obstacles.push(parked(id, s, l));
        self
    }

    pub(super) fn with(mut self, change: impl FnOnce(&mut Self)) -> Self {
        change(&mut self);
        self
    }

    /// Asks to pull over at `destination_s`, or at once.
    pub(super) fn pulling_over(mut self, destination_s: Option<f64>) -> Self {
        self.memory.pull_over.is_requested = true;
        self.memory.pull_over.kind = match destination_s {
            Some(s) => {
                self.destination = Some(self.road.to_cartesian(SlPoint { s, l: 0.0 }));
                PullOverKind::Destination
            }
            None => PullOverKind::Emergency,
        };
        self
    }

    pub(super) fn decide(&mut self) -> Result<PathBounds, PathBoundsError> {
        let input = Input {
            ego: self.ego,
            ego_end_s: self.ego.s + self.vehicle.front_edge_to_center,
            obstacles: &self.obstacles,
            config: &self.config,
            vehicle: &self.vehicle,
            cruise_speed: self.cruise_speed,
            is_change_lane: self.is_change_lane,
            path_reusable: false,
            borrow: &self.borrow,
            destination: self.destination,
        };
        path_bounds::decide(&self.road, &input, &mut self.memory)
    }

    /// The bound of one label; it must be there.
    pub(super) fn bound(&mut self, label: Label) -> PathBound {
        let bounds = self.decide().unwrap().bounds;
        let labels: Vec<_> = bounds.iter().map(|bound| bound.label).collect();
        let found = bounds.into_iter().find(|bound| bound.label == label);
        found.unwrap_or_else(|| panic!("no `{label}` among {labels:?}"))
    }
}

pub(super) fn parked(id: u32, s: (f64, f64), l: (f64, f64)) -> ObstacleSl {
    ObstacleSl {
        id: ObstacleId(id),
        start_s: s.0,
        end_s: s.1,
        start_l: l.0,
        end_l: l.1,
        speed: 0.0,
        is_static: true,
        is_virtual: false,
        is_ignored: false,
    }
}

pub(super) const OWN: Label = Label::Regular {
    borrow: Borrow::None,
    lane: LaneType::Own,
};

pub(super) const LEFT_FORWARD: Label = Label::Regular {
    borrow: Borrow::Left,
    lane: LaneType::Forward,
};

/// A lane of `width` to the side, its traffic going our way.
pub(super) fn forward_lane(side: Side, width: f64) -> [Option<f64>; 4] {
    let mut neighbours = [None; 4];
    neighbours[Neighbour { side, reverse: false }.index()] = Some(width);
    neighbours
}

/// The limits at station `s`, which must be one of the bound's.
pub(super) fn at(bound: &PathBound, s: f64) -> (f64, f64) {
    let point = bound.points.iter().find(|point| point.s == s);
    let point = point.unwrap_or_else(|| panic!("no station {s} up to {:?}", bound.points.last()));
    (point.l_min, point.l_max)
}

/// Asserts limits at all stations of the bound from `from` to `to`, both included.
pub(super) fn assert_limits(bound: &PathBound, from: f64, to: f64, wanted: (f64, f64)) {
    let inside: Vec<_> = (bound.points.iter())
        .filter(|point| point.s >= from && point.s <= to)
        .collect();
    assert!(!inside.is_empty(), "no station in {from}..={to}");
    for point in inside {
        assert!(
            (point.l_min - wanted.0).abs() < 1e-9 && (point.l_max - wanted.1).abs() < 1e-9,
            "{point:?} is not {wanted:?}"
        );
    }
}
