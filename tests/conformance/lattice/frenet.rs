//! Between the plane and the line.

use super::{LatticeCase, agrees, near};
use corridor_decider::geometry::Pose;
use corridor_decider::geometry::frenet::{Foot, FrenetMotion, PlaneMotion, slopes};
use serde::Deserialize;

const TOLERANCE: f64 = 1e-9;
const NEAR_SINGULAR: f64 = 1e-7;

#[derive(Deserialize)]
#[serde(default)]
struct Input {
    rs: f64,
    rx: f64,
    ry: f64,
    rtheta: f64,
    rkappa: f64,
    rdkappa: f64,
    x: f64,
    y: f64,
    v: f64,
    a: f64,
    theta: f64,
    kappa: f64,
    l: f64,
    dl: f64,
    ddl: f64,
    s: [f64; 3],
    d: [f64; 3],
}

impl Default for Input {
    fn default() -> Self {
        Self {
            rs: 0.0,
            rx: 0.0,
            ry: 0.0,
            rtheta: 0.0,
            rkappa: 0.0,
            rdkappa: 0.0,
            x: 0.0,
            y: 0.0,
            v: 0.0,
            a: 0.0,
            theta: 0.0,
            kappa: 0.0,
            l: 0.0,
            dl: 0.0,
            ddl: 0.0,
            s: [0.0; 3],
            d: [0.0; 3],
        }
    }
}

impl Input {
    fn foot(&self) -> Foot {
        Foot {
            s: self.rs,
            pose: Pose::new(self.rx, self.ry, self.rtheta),
            kappa: self.rkappa,
            dkappa: self.rdkappa,
        }
    }
}

fn tolerance(case: &LatticeCase) -> f64 {
    if case.name.contains("near_singular") {
        NEAR_SINGULAR
    } else {
        TOLERANCE
    }
}

/// A state that has no counterpart has to be rejected, another one must not be.
fn answered<T>(case: &LatticeCase, answer: Option<T>) -> Result<Option<T>, String> {
    match (case.is_defect() || case.fails(), answer) {
        (true, None) => Ok(None),
        (true, Some(_)) => Err("accepted, but it is singular".to_owned()),
        (false, None) => Err("rejected".to_owned()),
        (false, answer) => Ok(answer),
    }
}

pub(super) fn to_frenet(case: &LatticeCase) -> Result<(), String> {
    let input: Input = case.input()?;
    let motion = PlaneMotion {
        pose: Pose::new(input.x, input.y, input.theta),
        kappa: input.kappa,
        v: input.v,
        a: input.a,
    };
    let Some(found) = answered(case, input.foot().to_frenet(&motion))? else {
        return Ok(());
    };
    for k in 0..3 {
        near("s", &case.expected["s"][k], found.s[k], tolerance(case))?;
        near("d", &case.expected["d"][k], found.l[k], tolerance(case))?;
    }
    Ok(())
}

pub(super) fn to_sl(case: &LatticeCase) -> Result<(), String> {
    let input: Input = case.input()?;
    let foot = input.foot();
    near("s", &case.expected["s"], foot.s, TOLERANCE)?;
    near(
        "d",
        &case.expected["d"],
        foot.offset(Pose::new(input.x, input.y, 0.0)),
        TOLERANCE,
    )
}

pub(super) fn to_plane(case: &LatticeCase) -> Result<(), String> {
    let input: Input = case.input()?;
    let motion = FrenetMotion {
        s: input.s,
        l: input.d,
    };
    let Some(found) = answered(case, input.foot().to_plane(&motion))? else {
        return Ok(());
    };
    compare(case, &found)
}

fn compare(case: &LatticeCase, found: &PlaneMotion) -> Result<(), String> {
    let values = [
        ("x", found.pose.x),
        ("y", found.pose.y),
        ("kappa", found.kappa),
        ("v", found.v),
        ("a", found.a),
    ];
    for (key, got) in values {
        near(key, &case.expected[key], got, tolerance(case))?;
    }
    match super::number(&case.expected["theta"]) {
        Some(theta) if !same_direction(theta, found.pose.theta, tolerance(case)) => {
            Err(format!("theta: expected {theta}, got {}", found.pose.theta))
        }
        _ => Ok(()),
    }
}

pub(super) fn same_direction(wanted: f64, got: f64, tolerance: f64) -> bool {
    agrees(
        0.0,
        corridor_decider::geometry::angle::difference(got, wanted),
        tolerance,
    )
}

/// Parts of the conversion to the plane, asked for one by one.
pub(super) fn closed_form(case: &LatticeCase) -> Result<(), String> {
    let input: Input = case.input()?;
    let motion = FrenetMotion {
        s: [0.0; 3],
        l: [input.l, input.dl, input.ddl],
    };
    let found = input.foot().to_plane(&motion);
    if found.is_none() && case.expected["kappa"] == 0 {
        return Ok(());
    }
    match answered(case, found)? {
        Some(found) => compare(case, &found),
        None => Ok(()),
    }
}

pub(super) fn derivatives(case: &LatticeCase) -> Result<(), String> {
    let input: Input = case.input()?;
    let [dl, ddl] = slopes(&input.foot(), input.l, input.theta - input.rtheta, input.kappa);
    near("dl", &case.expected["dl"], dl, TOLERANCE)?;
    near("ddl", &case.expected["ddl"], ddl, TOLERANCE)
}
