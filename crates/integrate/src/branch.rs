//! The branch of the constraints on which a motion is.
//!
//! Branches cross at a singular position: when all bars of a parallelogram lie along one line, it could continue as
//! an antiparallelogram. If the distance to that position is below the error of the state, the least correction may
//! lead onto another branch, and removes the speeds that this branch does not allow. A correction that the error of a
//! step explains is small; a larger one is a leap between branches.

use crate::method::Method;
use crate::tolerances::Tolerances;

/// Changes of a speed up to this many tolerances, at the largest value of any speed so far, are explained by the errors
/// of explicit methods, and of implicit ones.
pub(crate) const TOLERANCES: (f64, f64) = (30.0, 1000.0);
/// Changes are also explained if they take at most this fraction of a relative tolerance from the kinetic energy; the
/// correction is orthogonal in that metric.
const ENERGY: f64 = 0.01;
/// Rounding errors explain changes that take up to this fraction of the kinetic energy, whatever the tolerance: a stage
/// at a distance x from a singular position, relative to the size of the coordinates, changes a speed by rounding errors
/// divided by the square of x.
const ROUNDING: f64 = 6e-13;

/// The largest speeds of a motion so far, which bound its corrections.
pub struct Branch {
    tolerances: Tolerances,
    explained: f64,
    largest: f64,
}

impl Branch {
    pub fn new(method: Method, tolerances: Tolerances) -> Self {
        let explained = if method.is_implicit() { TOLERANCES.1 } else { TOLERANCES.0 };
        Self { tolerances, explained, largest: 0.0 }
    }

    /// The largest change of a speed that a correction may make after a step from one state to another.
    pub fn bound(&mut self, before: &[f64], after: &[f64]) -> f64 {
        let here = before.iter().chain(after).fold(0.0, |size: f64, speed| size.max(speed.abs()));
        self.largest = self.largest.max(here);
        bound(&self.tolerances, self.explained, self.largest, here)
    }

    /// The largest speed so far.
    pub fn largest(&self) -> f64 {
        self.largest
    }

    /// Note the largest speed in steps that somebody else has bounded.
    pub fn note(&mut self, largest: f64) {
        self.largest = self.largest.max(largest);
    }
}

/// The largest change of a speed that is explained by so many tolerances, for the largest speed so far, and at the
/// ends of a step.
#[inline]
pub(crate) fn bound(tolerances: &Tolerances, explained: f64, largest: f64, here: f64) -> f64 {
    let Tolerances { relative, absolute, .. } = *tolerances;
    let least = explained * (absolute + relative * largest);
    least.max((ENERGY * relative).max(ROUNDING).sqrt() * here)
}
