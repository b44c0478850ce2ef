//! The kinds of things on an HD map that lanes overlap with.

/// What a map object is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[allow(missing_docs, reason = "the names say it")]
pub enum ObjectKind {
    Lane,
    Signal,
    YieldSign,
    StopSign,
    Crosswalk,
    Junction,
    PncJunction,
    ClearArea,
    SpeedBump,
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
