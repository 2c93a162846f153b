//! The table of functions: name, arity, parity, and value in doubles. Their values in the field and at special numbers are
//! in `canonical`, their derivatives in `calculus`.

use crate::error::Error;

/// A function with a known derivative and a known numeric value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Function {
    /// The sine.
    Sin,
    /// The cosine.
    Cos,
    /// The tangent.
    Tan,
    /// The angle in [-pi/2, pi/2] with this sine.
    Asin,
    /// The angle in [0, pi] with this cosine.
    Acos,
    /// The angle in (-pi/2, pi/2) with this tangent.
    Atan,
    /// The angle of the point (x, y) in (-pi, pi]: `atan2(y, x)`.
    Atan2,
    /// The hyperbolic sine.
    Sinh,
    /// The hyperbolic cosine.
    Cosh,
    /// The hyperbolic tangent.
    Tanh,
    /// The exponential.
    Exp,
    /// The natural logarithm.
    Log,
    /// The absolute value.
    Abs,
    /// The sign: -1, 0 or 1.
    Sign,
    /// The least of the arguments.
    Min,
    /// The greatest of the arguments.
    Max,
    /// A power `base ** exponent` whose exponent is not a number.
    Power,
    /// `Piecewise(v1, c1, v2, c2, ..., otherwise)`: the first value whose condition is positive.
    Piecewise,
}

/// f(-x) in terms of f(x).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Parity {
    Odd,
    Even,
    Neither,
}

/// How many arguments a function takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Arity {
    Exactly(usize),
    AtLeast(usize),
    /// Pairs of value and condition, then the value otherwise.
    Pairs,
}

/// A row of the table.
struct Entry {
    function: Function,
    name: &'static str,
    arity: Arity,
    parity: Parity,
}

const fn entry(function: Function, name: &'static str, arity: Arity, parity: Parity) -> Entry {
    Entry { function, name, arity, parity }
}

use Arity::{AtLeast, Exactly, Pairs};
use Parity::{Even, Neither, Odd};

const TABLE: [Entry; 18] = [
    entry(Function::Sin, "sin", Exactly(1), Odd),
    entry(Function::Cos, "cos", Exactly(1), Even),
    entry(Function::Tan, "tan", Exactly(1), Odd),
    entry(Function::Asin, "asin", Exactly(1), Odd),
    entry(Function::Acos, "acos", Exactly(1), Neither),
    entry(Function::Atan, "atan", Exactly(1), Odd),
    entry(Function::Atan2, "atan2", Exactly(2), Neither),
    entry(Function::Sinh, "sinh", Exactly(1), Odd),
    entry(Function::Cosh, "cosh", Exactly(1), Even),
    entry(Function::Tanh, "tanh", Exactly(1), Odd),
    entry(Function::Exp, "exp", Exactly(1), Neither),
    entry(Function::Log, "log", Exactly(1), Neither),
    entry(Function::Abs, "Abs", Exactly(1), Even),
    entry(Function::Sign, "sign", Exactly(1), Odd),
    entry(Function::Min, "Min", AtLeast(1), Neither),
    entry(Function::Max, "Max", AtLeast(1), Neither),
    entry(Function::Power, "Power", Exactly(2), Neither),
    entry(Function::Piecewise, "Piecewise", Pairs, Neither),
];

impl Function {
    /// All functions, in the order of the table.
    pub fn all() -> impl Iterator<Item = Self> {
        TABLE.iter().map(|entry| entry.function)
    }

    fn entry(self) -> &'static Entry {
        &TABLE[self as usize]
    }

    /// The name that prints and parses.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.entry().name
    }

    /// The function of this name.
    #[must_use]
    pub fn by_name(name: &str) -> Option<Self> {
        TABLE.iter().find(|entry| entry.name == name).map(|entry| entry.function)
    }

    pub(crate) const fn parity(self) -> Parity {
        TABLE[self as usize].parity
    }

    /// Whether the value is that of an argument or of a sign, as it is chosen by signs.
    pub(crate) fn is_choice(self) -> bool {
        matches!(self, Self::Abs | Self::Sign | Self::Min | Self::Max | Self::Piecewise)
    }

    /// Whether numbers as arguments decide which value it has, or whether it has one.
    pub(crate) fn is_decided_by_numbers(self) -> bool {
        let needs_range = matches!(self, Self::Asin | Self::Acos | Self::Atan | Self::Atan2 | Self::Log);
        needs_range || self.is_choice() || self == Self::Power
    }

    pub(crate) fn check_arity(self, found: usize) -> Result<(), Error> {
        let (fits, expected) = match self.entry().arity {
            Exactly(1) => (found == 1, "1 argument"),
            Exactly(_) => (found == 2, "2 arguments"),
            AtLeast(n) => (found >= n, "at least 1 argument"),
            Pairs => (found % 2 == 1, "pairs of value and condition and a last value for otherwise"),
        };
        if fits { Ok(()) } else { Err(Error::Arity { function: self.name(), expected, found }) }
    }

    /// The value at doubles.
    #[must_use]
    pub fn evaluate(self, args: &[f64]) -> f64 {
        let x = args[0];
        match self {
            Self::Sin => x.sin(),
            Self::Cos => x.cos(),
            Self::Tan => x.tan(),
            Self::Asin => x.asin(),
            Self::Acos => x.acos(),
            Self::Atan => x.atan(),
            Self::Atan2 => x.atan2(args[1]),
            Self::Sinh => x.sinh(),
            Self::Cosh => x.cosh(),
            Self::Tanh => x.tanh(),
            Self::Exp => x.exp(),
            Self::Log => x.ln(),
            Self::Abs => x.abs(),
            Self::Sign if x == 0.0 => 0.0,
            Self::Sign => x.signum(),
            Self::Min => {
                args.iter().fold(x, |a, &b| if a.is_nan() || b.is_nan() { f64::NAN } else { a.min(b) })
            }
            Self::Max => {
                args.iter().fold(x, |a, &b| if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) })
            }
            Self::Power => x.powf(args[1]),
            Self::Piecewise => {
                let chosen = args.chunks_exact(2).find(|pair| pair[1] > 0.0).map(|pair| pair[0]);
                chosen.unwrap_or(args[args.len() - 1])
            }
        }
    }
}
