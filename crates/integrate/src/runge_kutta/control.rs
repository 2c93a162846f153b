//! The control of the steps of an explicit method: their errors, their lengths, and the recognition of stiff problems.
//!
//! E. Hairer, S. P. Nørsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd ed., 1993, II.4; Hairer & Wanner,
//! volume II, IV.2.

use crate::tolerances::{INTEGRAL, Tolerances};

/// The next step depends on the error of the last one and, with a small weight, on that of the one before, so that few
/// steps are rejected. These two numbers take a sixth fewer evaluations than 0.9 and 0 on a double pendulum and on
/// Andrews' mechanism.
const SAFETY: f64 = 0.8;
const MEMORY: f64 = 0.04;
/// Smaller errors are recorded as this one.
pub(crate) const LEAST_ERROR: f64 = 1e-4;
const SHRINK: f64 = 0.333;
const GROW: f64 = 6.0;
/// A problem is stiff if the largest eigenvalue bounds this many steps.
const STIFF: u32 = 15;

/// The weight of an error in an entry of the state, which has these values at the ends of the step.
#[inline]
pub(crate) fn weight(tolerances: &Tolerances, before: f64, after: f64) -> f64 {
    1.0 / (tolerances.absolute + tolerances.relative * before.abs().max(after.abs()))
}

/// An entry of a vector in units of the tolerance of a state.
#[inline]
pub(crate) fn in_tolerances(tolerances: &Tolerances, entry: f64, state: f64) -> f64 {
    entry / (tolerances.absolute + tolerances.relative * state.abs())
}

/// The error that an integral along the motion may have in a step: by its largest value, and by that of its terms.
#[inline]
pub(crate) fn tolerance_of_integral(
    tolerances: &Tolerances,
    size: f64,
    after: f64,
    largest_term: f64,
) -> f64 {
    INTEGRAL * (tolerances.absolute + tolerances.relative * size.max(after.abs()).max(largest_term))
}

/// The error of a step in units of the tolerance, by the sums of the weighted squares of its estimates. A second
/// estimate damps the first [Hairer, Nørsett & Wanner 1993, II.10].
#[inline]
pub(crate) fn error_of_step(h: f64, squares: (f64, Option<f64>), entries: f64) -> f64 {
    match squares {
        (one, None) => h.abs() * (one / entries).sqrt(),
        (high, Some(low)) => {
            let both = high + 0.01 * low;
            if both <= 0.0 { 0.0 } else { h.abs() * high / (both * entries).sqrt() }
        }
    }
}

/// Whether a step is too short to advance the time.
#[inline]
pub(crate) fn is_too_short(t: f64, h: f64) -> bool {
    h <= 4.0 * f64::EPSILON * t.abs() || h < f64::MIN_POSITIVE
}

/// Whether a step from `t` is the last one: one that would leave a sliver is made a little longer.
#[inline]
pub(crate) fn is_last(t: f64, h: f64, end: f64) -> bool {
    t + 1.01 * h >= end
}

/// The factor to the next step after one that is accepted, by proportional and integral control; and what to
/// remember of its error.
pub(crate) fn factor_after(error: f64, last_error: f64, exponent: f64, was_rejected: bool) -> (f64, f64) {
    let now = error.max(f64::MIN_POSITIVE).ln();
    let factor = SAFETY * ((0.2 * MEMORY - exponent) * now + MEMORY * last_error).exp();
    let factor = factor.clamp(SHRINK, GROW);
    (if was_rejected { factor.min(1.0) } else { factor }, now.max(LEAST_ERROR.ln()))
}

/// The factor to a step after one that is rejected.
pub(crate) fn factor_after_rejection(error: f64, exponent: f64) -> f64 {
    if error.is_finite() { (SAFETY * error.powf(-exponent)).clamp(SHRINK, 1.0) } else { 0.1 }
}

/// The step times the largest eigenvalue. The last stage and the end of the step are at the same instant, so the
/// difference of their rates relative to that of their states is an estimate; both are given by their squares.
#[inline]
pub(crate) fn steepness(h: f64, rates: f64, states: f64) -> f64 {
    if states > 0.0 { h * (rates / states).sqrt() } else { 0.0 }
}

/// Count the steps that stability bounds; return whether the problem is stiff.
#[inline]
pub(crate) fn note_stiffness(count: &mut u32, is_at_bound: bool) -> bool {
    *count = if is_at_bound { *count + 1 } else { count.saturating_sub(1) };
    *count >= STIFF
}
