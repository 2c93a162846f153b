//! What ends an integration before its time.

use std::fmt;

/// Why an integration ended early.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// A rate of the state is no number, whatever the step.
    NotFinite {
        /// When.
        t: f64,
    },
    /// The error stays above the tolerance, however short the step.
    StepCollapse {
        /// When.
        t: f64,
        /// The last step tried.
        step: f64,
    },
    /// Steps are so short that the motion would never come to its end.
    Stalled {
        /// When.
        t: f64,
        /// The last step.
        step: f64,
    },
    /// The state can't be put back onto the constraints.
    Projection {
        /// When.
        t: f64,
        /// The last change of a coordinate or speed.
        change: f64,
    },
    /// However long the step to it, a state is put back onto the constraints by a leap of its speeds.
    Singular {
        /// When.
        t: f64,
        /// The change of a speed.
        change: f64,
        /// How large it may be.
        bound: f64,
    },
    /// Whoever watches asked to stop.
    Interrupted {
        /// When.
        t: f64,
    },
    /// The library that carries the state on says why it gave up.
    Library {
        /// When.
        t: f64,
        /// In its words.
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

    /// A word for the kind of failure.
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
