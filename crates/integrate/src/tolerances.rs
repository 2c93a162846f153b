//! The tolerances that methods of integration keep.

/// The error of an integral along the motion that is allowed in a step, in tolerances: nothing else depends on it.
pub const INTEGRAL: f64 = 10.0;

/// The accuracy and the longest step of an integration.
#[derive(Clone, Copy, Debug)]
pub struct Tolerances {
    /// The error of a step relative to the state.
    pub relative: f64,
    /// The error of a step where the state is small.
    pub absolute: f64,
    /// The longest step.
    pub max_step: f64,
    /// The number of entries of the state that are controlled; those after them are integrals along the motion.
    pub controlled: usize,
}
