//! The reasons why an integration ends early.

use std::fmt;

/// The reason why an integration ended early.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// A rate of the state is not a finite number, whatever the step.
    NotFinite {
        /// The instant up to which the motion is known.
        t: f64,
    },
    /// The error stays above the tolerance, however short the step.
    StepCollapse {
        /// The instant up to which the motion is known.
        t: f64,
        /// The last step tried.
        step: f64,
    },
    /// Steps are so short that the motion would never reach its end.
    Stalled {
        /// The instant up to which the motion is known.
        t: f64,
        /// The last step.
        step: f64,
    },
    /// The state can't be projected back onto the constraints.
    Projection {
        /// The instant up to which the motion is known.
        t: f64,
        /// The last change of a coordinate or speed.
        change: f64,
    },
    /// Whatever the length of the step, the projection onto the constraints changes the speeds by a leap.
    Singular {
        /// The instant up to which the motion is known.
        t: f64,
        /// The change of a speed.
        change: f64,
        /// The largest change that is allowed.
        bound: f64,
    },
    /// The caller asked to stop.
    Interrupted {
        /// The instant up to which the motion is known.
        t: f64,
    },
    /// The library that advances the state reports a failure.
    Library {
        /// The instant up to which the motion is known.
        t: f64,
        /// The message of the library.
        message: String,
    },
}

impl Failure {
    /// The instant up to which the motion is known.
    pub fn t(&self) -> f64 {
        match self {
            Self::NotFinite { t }
            | Self::StepCollapse { t, .. }
            | Self::Stalled { t, .. }
            | Self::Projection { t, .. }
            | Self::Singular { t, .. }
            | Self::Interrupted { t }
            | Self::Library { t, .. } => *t,
        }
    }

    /// The name of the kind of failure.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::NotFinite { .. } => "not_finite",
            Self::StepCollapse { .. } => "step_collapse",
            Self::Stalled { .. } => "stalled",
            Self::Projection { .. } => "projection",
            Self::Singular { .. } => "singular",
            Self::Interrupted { .. } => "interrupted",
            Self::Library { .. } => "library",
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite { .. } => write!(f, "a rate of the state is not a finite number"),
            Self::StepCollapse { step, .. } => {
                write!(f, "the step has shrunk to {step:.1e} without meeting the tolerances")
            }
            Self::Stalled { step, .. } => {
                write!(f, "steps of about {step:.1e} would never reach the end")
            }
            Self::Projection { change, .. } => {
                write!(
                    f,
                    "the state can't be put back onto the constraints (the last correction was {change:.1e})"
                )
            }
            Self::Singular { change, bound, .. } => {
                write!(
                    f,
                    "the constraints would change a speed by {change:.1e}, {:.3} times what a step's error explains",
                    change / bound
                )
            }
            Self::Interrupted { .. } => write!(f, "interrupted"),
            Self::Library { message, .. } => write!(f, "{message}"),
        }
    }
}
