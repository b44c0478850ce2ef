//! Apollo HD maps (`base_map.bin`, `base_map.txt`) and routings, in the binary and the text form of protocol buffers.
//!
//! Source: Apollo's `modules/common_msgs/map_msgs` and `routing_msgs`. Coordinates are those of the file, usually UTM
//! metres; height is not read.
//!
//! The steps: `wire` and `text` find the records of a file, `messages` says what their fields are called and numbered,
//! `convert` checks them into plain data, `sanity` holds them against each other.

mod convert;
mod fault;
mod messages;
mod read;
mod record;
mod road_map;
mod routing;
mod sanity;
mod text;
mod wire;

#[cfg(test)]
mod tests;

pub use read::read_map;
pub use road_map::to_road_map;
pub use routing::{read_routing, read_routing_request};
