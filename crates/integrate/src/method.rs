//! The methods of integration, by name, and the tolerances that they keep.

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

/// A method of integration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// The explicit Runge–Kutta method of order 8 by Dormand and Prince.
    Dop853,
    /// The explicit Runge–Kutta method of order 5 by Tsitouras.
    Tsit5,
    /// Backward differentiation formulae of variable order.
    Bdf,
    /// A singly diagonally implicit Runge–Kutta method of order 3.
    Esdirk34,
    /// The trapezoidal rule with a backward differentiation formula, of order 2.
    TrBdf2,
}

impl Method {
    /// The method with a name.
    pub fn named(name: &str) -> Option<Self> {
        Some(match name {
            "dop853" => Self::Dop853,
            "tsit5" => Self::Tsit5,
            "bdf" => Self::Bdf,
            "esdirk34" => Self::Esdirk34,
            "tr_bdf2" => Self::TrBdf2,
            _ => return None,
        })
    }

    /// Whether it needs the Jacobian.
    pub fn is_implicit(self) -> bool {
        !matches!(self, Self::Dop853 | Self::Tsit5)
    }
}
