//! The kinds of things on an HD map that lanes overlap with.

/// What a map object is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ObjectKind {
    /// Another lane.
    Lane,
    /// A traffic light.
    Signal,
    /// A yield sign.
    YieldSign,
    /// A stop sign.
    StopSign,
    /// A crosswalk.
    Crosswalk,
    /// A junction.
    Junction,
    /// A junction as planning sees it.
    PncJunction,
    /// An area to keep free.
    ClearArea,
    /// A speed bump.
    SpeedBump,
    /// A parking space.
    ParkingSpace,
}

impl ObjectKind {
    /// How many kinds there are.
    pub const COUNT: usize = 10;

    /// All kinds, in the order in which tables store them.
    pub const ALL: [Self; Self::COUNT] = [
        Self::Lane,
        Self::Signal,
        Self::YieldSign,
        Self::StopSign,
        Self::Crosswalk,
        Self::Junction,
        Self::PncJunction,
        Self::ClearArea,
        Self::SpeedBump,
        Self::ParkingSpace,
    ];

    /// Place in [`ObjectKind::ALL`].
    pub fn index(self) -> usize {
        self as usize
    }
}
