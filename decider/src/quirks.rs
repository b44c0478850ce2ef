//! Defects of the original around its path bounds, each as a switch that is read in one place. All off by default; a
//! sweep has to catch each of them.

use crate::piecewise_jerk::JerkCoupling;
use serde::{Deserialize, Serialize};

/// Defects of the pipeline and of its fallbacks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[expect(clippy::struct_excessive_bools, reason = "independent switches")]
pub struct Quirks {
    /// The jerk enters the optimisers' cost without the product of neighbours: a weight on acceleration and curvature.
    pub diagonal_jerk_hessian: bool,
    /// Where only the speed failed, the path of the tick before takes the place of the fresh one.
    pub fallback_discards_fresh_path: bool,
    /// Where only the path failed, none but the offset path is tried.
    pub fallback_forgets_last_path: bool,
    /// A tick that cannot be planned publishes the car's own pose, thirty times over.
    pub frozen_pose: bool,
}

impl Quirks {
    /// The original as shipped.
    pub fn apollo() -> Self {
        Self {
            diagonal_jerk_hessian: true,
            fallback_discards_fresh_path: true,
            fallback_forgets_last_path: true,
            frozen_pose: true,
        }
    }

    /// How the optimisers' cost has the jerk.
    pub fn jerk_coupling(&self) -> JerkCoupling {
        if self.diagonal_jerk_hessian {
            JerkCoupling::Diagonal
        } else {
            JerkCoupling::Symmetric
        }
    }
}
