//! From the obstacles of a file to bodies on the road with behaviours.

use super::Draft;
use super::door::{self, Hung};
use super::placement::{self, Spot};
use super::sampler::Table;
use crate::route::Road;
use crate::scenario::{AlongLine, Behaviour, IdmParams, LateralMove, Mobil, Obstacle, Trigger, Waypoint};
use crate::schema::ScenarioFile;
use crate::schema::obstacle;
use crate::schema::obstacle::{
    Common, Door, Idm, LaneAlong, LaneChange, LaneChoice, Parked, Pedestrian, Scripted, When,
};
use crate::validity::Rejection;
use corridor_decider::frame::{ObstacleId, ObstacleKind};
use corridor_decider::geometry::{ConvexPolygon, Pose, angle};
use corridor_decider::reference_line::{LineQuery, SlPoint};
use corridor_decider::road::{Neighbour, Side};
use std::sync::Arc;

/// Clear distance between the members of a row where the file names none, m: tight, but one can drive out.
const ROW_SPACING: f64 = 1.0;

/// Lane of oncoming traffic, seen from the ego's.
const ONCOMING: Neighbour = Neighbour {
    side: Side::Left,
    reverse: true,
};

/// Puts all obstacles of the file on the road.
///
/// # Errors
/// [`Rejection`] where one has no place.
pub(super) fn place_all(draft: &mut Draft, road: &Road, file: &ScenarioFile) -> Result<(), Rejection> {
    let numbers = draft.sampler;
    for (key, kind, rows) in [
        ("parked", ObstacleKind::Car, &file.parked),
        ("cone", ObstacleKind::Cone, &file.cone),
    ] {
        for (k, row) in rows.iter().enumerate() {
            Placer::new(draft, road, row.common(), kind, (key, k))
                .row(row, &numbers.table(format_args!("{key}[{k}].")))?;
        }
    }
    for (k, car) in file.moving.iter().enumerate() {
        let table = numbers.table(format_args!("moving[{k}]."));
        let placer = Placer::new(draft, road, car.common(), ObstacleKind::Car, ("moving", k));
        placer.driving(
            &table,
            table.number("speed", &car.speed),
            Behaviour::ConstantSpeed,
        )?;
    }
    for (k, car) in file.idm.iter().enumerate() {
        let table = numbers.table(format_args!("idm[{k}]."));
        Placer::new(draft, road, car.common(), ObstacleKind::Car, ("idm", k)).idm(car, &table)?;
    }
    for (k, body) in file.scripted.iter().enumerate() {
        let table = numbers.table(format_args!("scripted[{k}]."));
        Placer::new(draft, road, body.common(), ObstacleKind::Car, ("scripted", k)).scripted(body, &table)?;
    }
    for (k, walker) in file.pedestrian.iter().enumerate() {
        let table = numbers.table(format_args!("pedestrian[{k}]."));
        let placer = Placer::new(
            draft,
            road,
            walker.common(),
            ObstacleKind::Pedestrian,
            ("pedestrian", k),
        );
        placer.pedestrian(walker, &table)?;
    }
    Ok(())
}

/// Puts one entry of the file on the road.
struct Placer<'a, 'd> {
    draft: &'a mut Draft<'d>,
    road: &'a Road,
    common: Common<'a>,
    kind: ObstacleKind,
    name: String,
}

impl<'a, 'd> Placer<'a, 'd> {
    fn new(
        draft: &'a mut Draft<'d>,
        road: &'a Road,
        common: Common<'a>,
        kind: ObstacleKind,
        (key, k): (&str, usize),
    ) -> Self {
        Self {
            draft,
            road,
            common,
            kind: common.kind.unwrap_or(kind),
            name: common.name.map_or_else(|| format!("{key}[{k}]"), str::to_owned),
        }
    }

    fn shape(&self, table: &Table<'_>) -> ConvexPolygon {
        placement::shape(&self.common, self.kind, table)
    }

    /// Station of the entry's centre on the route's line.
    fn station(&self, table: &Table<'_>) -> f64 {
        self.draft.ego_s + table.number("ahead", self.common.ahead)
    }

    fn spot(
        &self,
        shape: &ConvexPolygon,
        s: f64,
        heading: f64,
        table: &Table<'_>,
    ) -> Result<Spot, Rejection> {
        placement::spot(self.road, &self.name, &self.common, shape, s, heading, table)
    }

    fn push(&mut self, name: String, shape: ConvexPolygon, spot: Spot, behaviour: Behaviour) {
        // A file holds far fewer than 2^32 obstacles: rows end at 200, and the text fits into memory.
        let id = u32::try_from(self.draft.obstacles.len()).unwrap_or(u32::MAX);
        self.draft.spots.push(spot);
        self.draft.obstacles.push(Obstacle {
            id: ObstacleId(id),
            name,
            kind: self.kind,
            shape,
            behaviour,
        });
    }

    /// A row of standing obstacles, each clear of the one before by its own spacing.
    fn row(mut self, row: &Parked, table: &Table<'_>) -> Result<(), Rejection> {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a whole number from 1 to 200"
        )]
        let count = table.number_or("count", row.count.as_ref(), 1.0) as u64;
        let mut s = self.station(table);
        let mut last_reach = 0.0;
        for k in 0..count {
            let member = row.count.is_some().then(|| table.item(k));
            let numbers = member.as_ref().unwrap_or(table);
            let shape = self.shape(numbers);
            let heading = numbers.number_or("heading", row.heading.as_ref(), 0.0);
            let [(back, front), _] = placement::extent(&shape, heading);
            if k > 0 {
                s += last_reach + numbers.number_or("spacing", row.spacing.as_ref(), ROW_SPACING) - back;
            }
            last_reach = front;
            let spot = self.spot(&shape, s, heading, numbers)?;
            let name = if count > 1 {
                format!("{}.{k}", self.name)
            } else {
                self.name.clone()
            };
            let pose = spot.pose(self.road);
            let width = shape
                .vertices()
                .iter()
                .fold(0.0, |width: f64, v| width.max(v.y.abs()));
            self.push(name.clone(), shape, spot, Behaviour::Parked(pose));
            if let Some(door) = &row.door {
                self.door(door, &name, pose, width, &numbers.table(format_args!("door.")));
            }
        }
        Ok(())
    }

    /// The door of a parked car at `pose` that reaches `beside` to its sides: a thin body of its own.
    fn door(&mut self, door: &Door, car: &str, pose: Pose, beside: f64, table: &Table<'_>) {
        let hung = Hung {
            car: pose,
            side: door.side,
            hinge: table.number_or("hinge", door.hinge.as_ref(), door::HINGE),
            beside,
            length: table.number_or("length", door.length.as_ref(), door::LENGTH),
        };
        let (angle_open, duration) = (
            table.number("angle", &door.angle),
            table.number("duration", &door.duration),
        );
        let stays = door.stays.as_ref().map(|stays| table.number("stays", stays));
        let waypoints = hung.swing(angle_open, duration, stays);
        let closed = waypoints[0].pose;
        let at = self.road.line.to_frenet(closed.position());
        let spot = Spot {
            s: at.s,
            l: at.l,
            heading: angle::difference(closed.theta, self.road.line.point(at.s).theta),
        };
        let trigger = trigger(&door.when, table);
        let kind = std::mem::replace(&mut self.kind, ObstacleKind::Other);
        self.push(
            format!("{car}, door"),
            hung.shape(),
            spot,
            Behaviour::Triggered { trigger, waypoints },
        );
        self.kind = kind;
    }

    /// A body that drives along its lane.
    fn driving(
        mut self,
        table: &Table<'_>,
        speed: f64,
        behaviour: impl FnOnce(AlongLine) -> Behaviour,
    ) -> Result<(), Rejection> {
        let shape = self.shape(table);
        let spot = self.spot(&shape, self.station(table), 0.0, table)?;
        let start = self.along(spot, speed)?;
        let name = self.name.clone();
        self.push(name, shape, spot, behaviour(start));
        Ok(())
    }

    /// The line a body drives on from `spot`: the route's own, or that of the oncoming lane there.
    fn along(&self, spot: Spot, speed: f64) -> Result<AlongLine, Rejection> {
        if self.common.lane != LaneChoice::Oncoming {
            return Ok(AlongLine {
                line: Arc::clone(&self.road.line),
                s: spot.s,
                l: spot.l,
                speed,
            });
        }
        let own = self.road.line.sample_at(spot.s).lane;
        let line = self
            .road
            .map
            .neighbour(own, ONCOMING)
            .and_then(|lane| self.road.line_from(lane));
        let line = line.ok_or_else(|| Rejection::NoLane {
            obstacle: self.name.clone(),
            lane: self.common.lane,
            s: spot.s,
        })?;
        let at = line.to_frenet(spot.pose(self.road).position());
        Ok(AlongLine {
            line,
            s: at.s,
            l: at.l,
            speed,
        })
    }

    fn idm(self, car: &Idm, table: &Table<'_>) -> Result<(), Rejection> {
        let usual = IdmParams::default();
        let speed = table.number("speed", &car.speed);
        let number = |key, value: Option<_>, default| table.number_or(key, value, default);
        let acceleration = |key, value: Option<_>, default| table.number_or(key, value, default);
        let params = IdmParams {
            desired_speed: table.number_or("desired_speed", car.desired_speed.as_ref(), speed.max(1.0)),
            time_gap: table.number_or("time_gap", car.time_gap.as_ref(), usual.time_gap),
            min_gap: number("min_gap", car.min_gap.as_ref(), usual.min_gap),
            max_acceleration: acceleration(
                "max_acceleration",
                car.max_acceleration.as_ref(),
                usual.max_acceleration,
            ),
            comfortable_braking: acceleration(
                "comfortable_braking",
                car.comfortable_braking.as_ref(),
                usual.comfortable_braking,
            ),
        };
        let road = self.road;
        let wishes = car.mobil.as_ref();
        let wishes = wishes.map(|wishes| mobil(wishes, &table.table(format_args!("mobil."))));
        let change = car
            .lane_change
            .as_ref()
            .map(|change| (change, table.table(format_args!("lane_change."))));
        let lanes = car.mobil.as_ref().and_then(|wishes| wishes.lanes.as_deref());
        self.driving(table, speed, |start| {
            let lane_change = change.map(|(change, numbers)| lateral_move(road, &start, change, &numbers));
            let mobil = wishes.map(|wishes| Mobil {
                lanes: lane_centres(&start, lanes),
                ..wishes
            });
            Behaviour::Idm {
                start,
                params,
                lane_change,
                mobil,
            }
        })
    }

    fn scripted(mut self, body: &Scripted, table: &Table<'_>) -> Result<(), Rejection> {
        let shape = self.shape(table);
        let heading = table.number_or("heading", body.heading.as_ref(), 0.0);
        let spot = self.spot(&shape, self.station(table), heading, table)?;
        let mut last = Waypoint {
            t: 0.0,
            pose: spot.pose(self.road),
        };
        let mut waypoints = vec![last];
        for (k, point) in body.waypoints.iter().enumerate() {
            let numbers = table.table(format_args!("waypoints[{k}]."));
            let s = self.draft.ego_s + numbers.number("ahead", &point.ahead);
            self.on_line(s)?;
            let l = numbers.number_or("l", point.l.as_ref(), 0.0);
            let turned = |heading| Spot { s, l, heading }.pose(self.road);
            let pose = match &point.heading {
                Some(heading) => turned(numbers.number("heading", heading)),
                None => facing(last.pose, turned(0.0)),
            };
            last = Waypoint {
                t: last.t + numbers.number("after", &point.after),
                pose,
            };
            waypoints.push(last);
        }
        let name = self.name.clone();
        let behaviour = match &body.when {
            Some(when) => Behaviour::Triggered {
                trigger: trigger(when, table),
                waypoints,
            },
            None => Behaviour::Waypoints(waypoints),
        };
        self.push(name, shape, spot, behaviour);
        Ok(())
    }

    fn pedestrian(mut self, walker: &Pedestrian, table: &Table<'_>) -> Result<(), Rejection> {
        let shape = self.shape(table);
        let s = self.station(table);
        let spot = self.spot(&shape, s, 0.0, table)?;
        let ahead = s - self.draft.ego_s;
        let to_s = self.draft.ego_s + table.number_or("to_ahead", walker.to_ahead.as_ref(), ahead);
        self.on_line(to_s)?;
        let to_l = table.number("to", &walker.to);
        let behaviour = Behaviour::Pedestrian {
            from: spot.pose(self.road).position(),
            to: self.road.line.to_cartesian(SlPoint { s: to_s, l: to_l }),
            speed: table.number("speed", &walker.speed),
            trigger: trigger(&walker.when, table),
        };
        let name = self.name.clone();
        self.push(name, shape, spot, behaviour);
        Ok(())
    }

    fn on_line(&self, s: f64) -> Result<(), Rejection> {
        if (0.0..=self.road.line.length()).contains(&s) {
            return Ok(());
        }
        Err(Rejection::OffMap {
            obstacle: self.name.clone(),
            s,
        })
    }
}

/// `to`, turned along the leg from `from`; a leg without length keeps the heading.
fn facing(from: Pose, to: Pose) -> Pose {
    let leg = to.position() - from.position();
    let theta = if leg.norm() > 1e-6 {
        libm::atan2(leg.y, leg.x)
    } else {
        from.theta
    };
    Pose::new(to.x, to.y, theta)
}

/// When the obstacle of a table sets off.
fn trigger(when: &When, table: &Table<'_>) -> Trigger {
    match when {
        When::At(time) => Trigger::Time(table.number("when.at", time)),
        When::Within(distance) => Trigger::EgoWithin(table.number("when.within", distance)),
    }
}

/// How a driver chooses among lanes that are not yet named.
fn mobil(wishes: &obstacle::Mobil, table: &Table<'_>) -> Mobil {
    let usual = Mobil::default();
    Mobil {
        politeness: table.number_or("politeness", wishes.politeness.as_ref(), usual.politeness),
        threshold: table.number_or("threshold", wishes.threshold.as_ref(), usual.threshold),
        safe_braking: table.number_or("safe_braking", wishes.safe_braking.as_ref(), usual.safe_braking),
        duration: table.number_or("duration", wishes.duration.as_ref(), usual.duration),
        ..usual
    }
}

/// Centres of the lanes beside a driver's line where it starts, m; of all that there are, if none are named.
fn lane_centres(start: &AlongLine, named: Option<&[LaneAlong]>) -> Vec<f64> {
    let sample = start.line.sample_at(start.s);
    let lanes = named.unwrap_or(&[LaneAlong::Own, LaneAlong::Left, LaneAlong::Right]);
    let edges = lanes.iter().filter_map(|lane| {
        let lane = match lane {
            LaneAlong::Own => LaneChoice::Own,
            LaneAlong::Left => LaneChoice::Left,
            LaneAlong::Right => LaneChoice::Right,
        };
        placement::lane_edges(sample, lane)
    });
    edges.map(|(right, left)| f64::midpoint(right, left)).collect()
}

/// A change of lane, with its end in the frame of the line that the body drives on.
fn lateral_move(road: &Road, start: &AlongLine, change: &LaneChange, table: &Table<'_>) -> LateralMove {
    let to = table.number("to", &change.to);
    let to_l = if Arc::ptr_eq(&start.line, &road.line) {
        to
    } else {
        let here = start.line.to_cartesian(SlPoint {
            s: start.s,
            l: start.l,
        });
        let s = road.line.to_frenet(here).s;
        start
            .line
            .to_frenet(road.line.to_cartesian(SlPoint { s, l: to }))
            .l
    };
    LateralMove {
        trigger: trigger(&change.when, table),
        to_l,
        duration: table.number("duration", &change.duration),
    }
}
