//! The messages of an Apollo HD map and of a routing response, as far as they are read.
//!
//! Protocol buffers version 2. One declaration serves both formats: `prost` reads the numbers of the binary one, and
//! [`Value`] the names of the text one. Source: Apollo's `map.proto`, `map_lane.proto` and their neighbours, whose
//! numbers have not changed from version 3 to 11. What is not listed is skipped.

use super::text::{Field, Slot, TextError, Value};

/// Names of the values of an enumeration.
pub(super) type Names = &'static [(&'static str, i32)];

const LANE_TYPES: Names = &[
    ("NONE", 1),
    ("CITY_DRIVING", 2),
    ("BIKING", 3),
    ("SIDEWALK", 4),
    ("PARKING", 5),
    ("SHOULDER", 6),
    ("SHARED", 7),
];
const LANE_TURNS: Names = &[("NO_TURN", 1), ("LEFT_TURN", 2), ("RIGHT_TURN", 3), ("U_TURN", 4)];
const LANE_DIRECTIONS: Names = &[("FORWARD", 1), ("BACKWARD", 2), ("BIDIRECTION", 3)];
const BOUNDARY_TYPES: Names = &[
    ("UNKNOWN", 0),
    ("DOTTED_YELLOW", 1),
    ("DOTTED_WHITE", 2),
    ("SOLID_YELLOW", 3),
    ("SOLID_WHITE", 4),
    ("DOUBLE_YELLOW", 5),
    ("CURB", 6),
];
const ROAD_TYPES: Names = &[("UNKNOWN", 0), ("HIGHWAY", 1), ("CITY_ROAD", 2), ("PARK", 3)];
const EDGE_TYPES: Names = &[
    ("UNKNOWN", 0),
    ("NORMAL", 1),
    ("LEFT_BOUNDARY", 2),
    ("RIGHT_BOUNDARY", 3),
];
const CHANGE_TYPES: Names = &[("FORWARD", 0), ("LEFT", 1), ("RIGHT", 2)];

/// The names that belong to a field, if it has some.
macro_rules! names {
    () => {
        &[]
    };
    ($names:ident) => {
        $names
    };
}

/// Declares messages: `field: type = rule kind number, names of the values`.
macro_rules! messages {
    ($($(#[$doc:meta])* $message:ident {
        $($field:ident: $type:ty = $rule:ident $kind:ident $number:tt $($names:ident)?;)*
    })*) => {$(
        $(#[$doc])*
        #[derive(Clone, PartialEq, prost::Message)]
        pub(super) struct $message {
            $(#[prost($kind, $rule, tag = $number)]
            pub(super) $field: $type,)*
        }

        impl Value for $message {
            fn read(field: &Field<'_>, _: Names) -> Result<Self, TextError> {
                let mut message = Self::default();
                for inner in field.inside()? {
                    $(if inner.name == stringify!($field).trim_start_matches("r#") {
                        message.$field.put(inner, names!($($names)?))?;
                    })*
                }
                Ok(message)
            }
        }
    )*};
}

messages! {
    /// A name.
    Id {
        id: Option<String> = optional string 1;
    }
    /// A point; height is not read.
    Point {
        x: Option<f64> = optional double 1;
        y: Option<f64> = optional double 2;
    }
    /// Corners of an area.
    Polygon {
        point: Vec<Point> = repeated message 1;
    }
    /// A polyline.
    LineSegment {
        point: Vec<Point> = repeated message 1;
    }
    /// A piece of a curve; Apollo knows no other form than the polyline.
    CurveSegment {
        line_segment: Option<LineSegment> = optional message 1;
    }
    /// Pieces one after the other.
    Curve {
        segment: Vec<CurveSegment> = repeated message 1;
    }
    /// What is painted on a lane's edge from a station on.
    LaneBoundaryType {
        s: Option<f64> = optional double 1;
        types: Vec<i32> = repeated int32 2 BOUNDARY_TYPES;
    }
    /// The edge of a lane.
    LaneBoundary {
        curve: Option<Curve> = optional message 1;
        r#virtual: Option<bool> = optional bool 3;
        boundary_type: Vec<LaneBoundaryType> = repeated message 4;
    }
    /// A half width at a station.
    LaneSample {
        s: Option<f64> = optional double 1;
        width: Option<f64> = optional double 2;
    }
    /// A lane.
    Lane {
        id: Option<Id> = optional message 1;
        central_curve: Option<Curve> = optional message 2;
        left_boundary: Option<LaneBoundary> = optional message 3;
        right_boundary: Option<LaneBoundary> = optional message 4;
        length: Option<f64> = optional double 5;
        speed_limit: Option<f64> = optional double 6;
        overlap_id: Vec<Id> = repeated message 7;
        predecessor_id: Vec<Id> = repeated message 8;
        successor_id: Vec<Id> = repeated message 9;
        left_neighbor_forward_lane_id: Vec<Id> = repeated message 10;
        right_neighbor_forward_lane_id: Vec<Id> = repeated message 11;
        r#type: Option<i32> = optional int32 12 LANE_TYPES;
        turn: Option<i32> = optional int32 13 LANE_TURNS;
        left_neighbor_reverse_lane_id: Vec<Id> = repeated message 14;
        right_neighbor_reverse_lane_id: Vec<Id> = repeated message 15;
        junction_id: Option<Id> = optional message 16;
        left_sample: Vec<LaneSample> = repeated message 17;
        right_sample: Vec<LaneSample> = repeated message 18;
        direction: Option<i32> = optional int32 19 LANE_DIRECTIONS;
        left_road_sample: Vec<LaneSample> = repeated message 20;
        right_road_sample: Vec<LaneSample> = repeated message 21;
    }
    /// One edge of a road.
    BoundaryEdge {
        curve: Option<Curve> = optional message 1;
        r#type: Option<i32> = optional int32 2 EDGE_TYPES;
    }
    /// Edges of a road that together go round it.
    BoundaryPolygon {
        edge: Vec<BoundaryEdge> = repeated message 1;
    }
    /// The outline of a road; holes in it are not read.
    RoadBoundary {
        outer_polygon: Option<BoundaryPolygon> = optional message 1;
    }
    /// Lanes side by side.
    RoadSection {
        id: Option<Id> = optional message 1;
        lane_id: Vec<Id> = repeated message 2;
        boundary: Option<RoadBoundary> = optional message 3;
    }
    /// A road.
    Road {
        id: Option<Id> = optional message 1;
        section: Vec<RoadSection> = repeated message 2;
        junction_id: Option<Id> = optional message 3;
        r#type: Option<i32> = optional int32 4 ROAD_TYPES;
    }
    /// A junction, a crosswalk, a parking space or a junction of planning: these fields are the same in all.
    Outline {
        id: Option<Id> = optional message 1;
        polygon: Option<Polygon> = optional message 2;
        overlap_id: Vec<Id> = repeated message 3;
    }
    /// An area to keep free.
    ClearArea {
        id: Option<Id> = optional message 1;
        overlap_id: Vec<Id> = repeated message 2;
        polygon: Option<Polygon> = optional message 3;
    }
    /// A traffic light.
    Signal {
        id: Option<Id> = optional message 1;
        boundary: Option<Polygon> = optional message 2;
        overlap_id: Vec<Id> = repeated message 4;
        stop_line: Vec<Curve> = repeated message 6;
    }
    /// A stop sign or a yield sign.
    Sign {
        id: Option<Id> = optional message 1;
        stop_line: Vec<Curve> = repeated message 2;
        overlap_id: Vec<Id> = repeated message 3;
    }
    /// A speed bump.
    SpeedBump {
        id: Option<Id> = optional message 1;
        overlap_id: Vec<Id> = repeated message 2;
        position: Vec<Curve> = repeated message 3;
    }
    /// A lane's part in an overlap.
    LaneOverlapInfo {
        start_s: Option<f64> = optional double 1;
        end_s: Option<f64> = optional double 2;
        is_merge: Option<bool> = optional bool 3;
    }
    /// One thing of an overlap. At most one of the infos is there; the original has them in a `oneof`, which looks
    /// the same in a file.
    ObjectOverlapInfo {
        id: Option<Id> = optional message 1;
        lane_overlap_info: Option<LaneOverlapInfo> = optional message 3;
        signal_overlap_info: Option<Empty> = optional message 4;
        stop_sign_overlap_info: Option<Empty> = optional message 5;
        crosswalk_overlap_info: Option<Empty> = optional message 6;
        junction_overlap_info: Option<Empty> = optional message 7;
        yield_sign_overlap_info: Option<Empty> = optional message 8;
        clear_area_overlap_info: Option<Empty> = optional message 9;
        speed_bump_overlap_info: Option<Empty> = optional message 10;
        parking_space_overlap_info: Option<Empty> = optional message 11;
        pnc_junction_overlap_info: Option<Empty> = optional message 12;
        rsu_overlap_info: Option<Empty> = optional message 13;
        area_overlap_info: Option<Empty> = optional message 14;
        barrier_gate_overlap_info: Option<Empty> = optional message 15;
    }
    /// Things that lie on each other.
    Overlap {
        id: Option<Id> = optional message 1;
        object: Vec<ObjectOverlapInfo> = repeated message 2;
    }
    /// How the coordinates came about.
    Projection {
        proj: Option<String> = optional string 1;
    }
    /// The head of a map.
    Header {
        projection: Option<Projection> = optional message 3;
    }
    /// A stretch of a lane to drive along.
    LaneSegment {
        id: Option<String> = optional string 1;
        start_s: Option<f64> = optional double 2;
        end_s: Option<f64> = optional double 3;
    }
    /// Consecutive stretches.
    Passage {
        segment: Vec<LaneSegment> = repeated message 1;
        can_exit: Option<bool> = optional bool 2;
        change_lane_type: Option<i32> = optional int32 3 CHANGE_TYPES;
    }
    /// Passages side by side.
    RoadSegment {
        id: Option<String> = optional string 1;
        passage: Vec<Passage> = repeated message 2;
    }
    /// A place to pass.
    LaneWaypoint {
        id: Option<String> = optional string 1;
        s: Option<f64> = optional double 2;
        pose: Option<Point> = optional message 3;
        heading: Option<f64> = optional double 4;
    }
    /// What was asked for. What to avoid is not read, and from field 6 on versions differ.
    RoutingRequest {
        waypoint: Vec<LaneWaypoint> = repeated message 2;
    }
    /// The way to go.
    RoutingResponse {
        road: Vec<RoadSegment> = repeated message 2;
        routing_request: Option<RoutingRequest> = optional message 4;
    }
}

/// A message of which only the presence tells something.
#[derive(Clone, PartialEq, prost::Message)]
pub(super) struct Empty {}

impl Value for Empty {
    fn read(field: &Field<'_>, _: Names) -> Result<Self, TextError> {
        field.inside().map(|_| Self {})
    }
}
