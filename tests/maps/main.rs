//! Real maps of other people, read and checked against numbers that were measured without the importer.
//!
//! The files are not part of the repository. They are looked for in the folder that `CORRIDOR_MAPS` names, else
//! beside the workspace in `../shared/maps`. Without them the tests say so and pass, unless
//! `CORRIDOR_REQUIRE_MAPS` is set.

mod apollo;
mod commonroad;
mod lanelet2;
mod opendrive;
mod scenarios;
mod sound;
mod support;
