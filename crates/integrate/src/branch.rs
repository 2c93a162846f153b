//! Which branch of the constraints a motion is on.
//!
//! At a singular position branches cross: all bars of a parallelogram lie along one line, and it could go on as an
//! antiparallelogram. Nearer to it than the error of the state, the least correction may lead onto another branch, and
//! takes from the speeds what that one does not allow. A correction that the error of a step explains is small; a larger
//! one is a leap between branches.

use crate::method::{Method, Tolerances};

/// Changes of a speed up to this many tolerances, for the largest that any speed has been, are explained: by the errors of
/// explicit methods, and by those of implicit ones.
const TOLERANCES: (f64, f64) = (30.0, 1000.0);
/// And so are changes that take no more than this part of a relative tolerance from the kinetic energy, to which the
/// correction is orthogonal.
const ENERGY: f64 = 0.01;

/// How large the speeds of a motion have been.
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

    /// How far a correction may change a speed after a step from one state to another.
    pub fn bound(&mut self, before: &[f64], after: &[f64]) -> f64 {
        let Tolerances { relative, absolute, .. } = self.tolerances;
        let here = before.iter().chain(after).fold(0.0, |size: f64, speed| size.max(speed.abs()));
        self.largest = self.largest.max(here);
        let least = self.explained * (absolute + relative * self.largest);
        least.max((ENERGY * relative).sqrt() * here)
    }
}
