//! What an object is, by the type names of OpenDRIVE 1.1 to 1.8 and those that programs made up.

/// What an object is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum ObjectKind {
    /// A place to park one car: paint, not a body.
    ParkingSpace,
    /// A crossing for pedestrians: paint.
    Crosswalk,
    /// Other paint or a patch of another surface.
    RoadMark,
    /// A guard rail, a wall, a fence.
    Barrier,
    /// A thin upright thing: lamp, post, delineator.
    Pole,
    /// A tree.
    Tree,
    /// Bushes and hedges.
    Vegetation,
    /// A house.
    Building,
    /// Kerbed ground between lanes.
    TrafficIsland,
    /// A frame over the road.
    Gantry,
    /// Anything else that stands in the way, and vehicles drawn into the map.
    Obstacle,
    /// A type that is missing or not known.
    Other,
}

impl ObjectKind {
    /// By the `type` of the file.
    pub(super) fn named(name: &str) -> Self {
        match name.to_ascii_lowercase().as_str() {
            "parkingspace" => Self::ParkingSpace,
            "crosswalk" => Self::Crosswalk,
            "roadmark" | "roadsurface" | "patch" => Self::RoadMark,
            "barrier" | "railing" | "guardrail" | "soundbarrier" | "wall" | "fence" => Self::Barrier,
            "pole" | "rail-pole" | "guide-post" | "streetlamp" => Self::Pole,
            "tree" => Self::Tree,
            "vegetation" => Self::Vegetation,
            "building" => Self::Building,
            "trafficisland" => Self::TrafficIsland,
            "gantry" => Self::Gantry,
            "obstacle" | "car" | "van" | "bus" | "trailer" | "bike" | "motorbike" | "tram" | "train"
            | "pedestrian" => Self::Obstacle,
            _ => Self::Other,
        }
    }

    /// Whether a wheel may roll over it.
    pub fn is_flat(self) -> bool {
        matches!(self, Self::ParkingSpace | Self::Crosswalk | Self::RoadMark)
    }
}
