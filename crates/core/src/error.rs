//! What can go wrong while an expression is built; the bindings turn each case into one Python exception.

use std::fmt;

/// An error of the expression core, in the user's own names.
#[derive(Clone, Debug, PartialEq)]
pub enum Error {
    /// A divisor that is identically zero; holds what was to be divided.
    DivisionByZero(String),
    /// A double that is infinite or not a number.
    NotFinite(f64),
    /// A power whose exact value would fill the memory.
    NumberTooLarge(String),
    /// A function called with the wrong number of arguments.
    Arity {
        /// Its name.
        function: &'static str,
        /// How many it takes, in words.
        expected: &'static str,
        /// How many there were.
        found: usize,
    },
    /// A function outside its domain on an exact argument.
    Domain {
        /// Its name.
        function: &'static str,
        /// Where it has no value.
        argument: String,
    },
    /// Matrices whose shapes do not match.
    Shape {
        /// What was to be done.
        operation: &'static str,
        /// Rows and columns of the first.
        left: (usize, usize),
        /// Rows and columns of the second.
        right: (usize, usize),
    },
    /// Equations that do not determine their unknowns.
    Singular(String),
    /// Equations that are not linear in an unknown.
    NotLinear {
        /// The left side of the equation.
        equation: String,
        /// The unknown that is not linear in it.
        unknown: String,
    },
    /// A request beyond a stated limit.
    Limit {
        /// What is limited.
        what: &'static str,
        /// The most there may be.
        limit: usize,
        /// How many there were.
        found: usize,
    },
    /// A variable of differentiation or substitution that is not one.
    NotAVariable(String),
    /// An input of a compiled function that nobody gave a value.
    MissingInput(String),
}

/// Characters of an expression that a message quotes: its beginning, and its end.
const QUOTED: (usize, usize) = (51, 26);

/// What a message quotes of a text: all of it, or its beginning and its end.
#[must_use]
pub fn quoted(text: &str) -> String {
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let length = line.chars().count();
    let (beginning, end) = QUOTED;
    if length <= beginning + end + 3 {
        return line;
    }
    let head: String = line.chars().take(beginning).collect();
    let tail: String = line.chars().skip(length - end).collect();
    format!("{head}...{tail}")
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::DivisionByZero(dividend) => {
                write!(f, "{dividend} is divided by an expression that is identically zero")
            }
            Self::NotFinite(value) => {
                write!(f, "{value} is not a finite number; expressions hold finite numbers only")
            }
            Self::NumberTooLarge(power) => {
                write!(
                    f,
                    "{power} has more than a million digits; use a symbol instead, or a smaller exponent"
                )
            }
            Self::Arity { function, expected, found } => {
                write!(f, "{function} takes {expected}, found {found}")
            }
            Self::Domain { function, argument } => write!(f, "{function} is not defined at {argument}"),
            Self::Shape { operation, left, right } => write!(
                f,
                "{operation} of a {}x{} and a {}x{} matrix: the shapes do not match",
                left.0, left.1, right.0, right.1
            ),
            Self::Singular(text) | Self::MissingInput(text) => write!(f, "{text}"),
            Self::NotLinear { equation, unknown } => {
                write!(f, "the equation {equation} = 0 is not linear in {unknown}")
            }
            Self::Limit { what, limit, found } => write!(f, "{what}: at most {limit}, found {found}"),
            Self::NotAVariable(text) => {
                write!(
                    f,
                    "{text} is not a variable; use a symbol, a function of time or one of its derivatives"
                )
            }
        }
    }
}

impl std::error::Error for Error {}
