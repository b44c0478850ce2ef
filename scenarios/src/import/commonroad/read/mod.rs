//! From the text of a file to [`File`]: every element that something is made of, in either version.
//!
//! What a file may leave out is left out; what it must not is told with its place. Elements that nothing is made
//! of (location, tags, signal series) are not looked at.

mod road;
mod values;

use super::data::{File, Obstacle, Position, Prediction, Problem, Role, State};
use crate::import::ImportError;
use crate::import::notes::Notes;
use crate::import::xml::Element;

/// Name of the root.
pub(super) const ROOT: &str = "commonRoad";

/// Longest and shortest time step, s: real files have 0.04 to 0.25.
const STEPS: (f64, f64) = (1e-3, 10.0);

/// The whole file.
pub(super) fn file(root: Element<'_>, notes: &mut Notes<'_>) -> Result<File, ImportError> {
    let version = root.text("commonRoadVersion").unwrap_or_default();
    if !["2018b", "2020a"].contains(&version) {
        notes.add("is read like version 2020a", root.place(), || {
            format!("version `{version}`")
        });
    }
    let time_step = root.number("timeStepSize")?;
    if !(STEPS.0..=STEPS.1).contains(&time_step) {
        let expected = format!("seconds, from {} to {}", STEPS.0, STEPS.1);
        return Err(root.error(format!("has timeStepSize=\"{time_step}\""), expected));
    }
    let mut obstacles = Vec::new();
    let mut problems = Vec::new();
    for element in root.elements() {
        match element.name() {
            "environmentObstacle" if element.child("shape").is_none() => notes.add(
                "surroundings without a shape are left out",
                element.place(),
                || "<environmentObstacle>".to_owned(),
            ),
            "obstacle" | "staticObstacle" | "dynamicObstacle" | "environmentObstacle" | "phantomObstacle" => {
                obstacles.push(obstacle(element)?);
            }
            "planningProblem" => problems.push(problem(element)?),
            _ => {}
        }
    }
    Ok(File {
        version: version.to_owned(),
        benchmark: root.text("benchmarkID").unwrap_or_default().to_owned(),
        time_step,
        lanelets: road::lanelets(root, notes)?,
        signs: road::signs(root, notes),
        lights: road::lights(root, notes),
        intersections: road::intersections(root)?,
        obstacles,
        problems,
    })
}

fn obstacle(element: Element<'_>) -> Result<Obstacle, ImportError> {
    let role = role(element)?;
    let stands = matches!(role, Role::Static | Role::Dynamic);
    let initial = match element.child("initialState") {
        Some(state) => Some(values::state(state)?),
        None if stands => Some(values::state(element.required_child("initialState")?)?),
        None => None,
    };
    let shape = match element.child("shape") {
        Some(shape) => values::shapes(shape)?,
        None if role == Role::Phantom => Vec::new(),
        None => values::shapes(element.required_child("shape")?)?,
    };
    let kind = element.child("type").and_then(Element::content);
    Ok(Obstacle {
        id: values::id(element, "id")?,
        role,
        kind: kind.unwrap_or("unknown").to_owned(),
        shape,
        initial,
        prediction: prediction(element)?,
    })
}

fn role(element: Element<'_>) -> Result<Role, ImportError> {
    Ok(match element.name() {
        "staticObstacle" => Role::Static,
        "dynamicObstacle" => Role::Dynamic,
        "environmentObstacle" => Role::Environment,
        "phantomObstacle" => Role::Phantom,
        _ => {
            let role = element.required_child("role")?;
            match role.content() {
                Some("static") => Role::Static,
                Some("dynamic") => Role::Dynamic,
                Some("environment") => Role::Environment,
                Some("phantom") => Role::Phantom,
                other => {
                    let found = format!("is `{}`", other.unwrap_or_default());
                    return Err(role.error(found, "static, dynamic, environment or phantom"));
                }
            }
        }
    })
}

fn prediction(element: Element<'_>) -> Result<Prediction, ImportError> {
    if let Some(trajectory) = element.child("trajectory") {
        let states = trajectory.children("state").map(values::state);
        return Ok(Prediction::Trajectory(states.collect::<Result<_, _>>()?));
    }
    let Some(set) = element.child("occupancySet") else {
        return Ok(Prediction::None);
    };
    let occupancy = |element: Element<'_>| {
        let time = values::interval(element.required_child("time")?)?;
        Ok((time, values::shapes(element.required_child("shape")?)?))
    };
    let occupancies = set.children("occupancy").map(occupancy);
    Ok(Prediction::Occupancy(
        occupancies.collect::<Result<_, ImportError>>()?,
    ))
}

fn problem(element: Element<'_>) -> Result<Problem, ImportError> {
    let goals: Vec<State> = element
        .children("goalState")
        .map(values::state)
        .collect::<Result<_, _>>()?;
    if goals.is_empty() {
        element.required_child("goalState")?;
    }
    let start = element.required_child("initialState")?;
    let initial = values::state(start)?;
    if !matches!(initial.position, Some(Position::Point(_) | Position::Shapes(_))) {
        return Err(start.error("does not say where", "a <position> with a <point> or a shape"));
    }
    Ok(Problem {
        id: values::id(element, "id")?,
        place: element.text_place(),
        initial,
        goals,
    })
}
