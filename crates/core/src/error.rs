//! What can go wrong while an expression is built; the bindings turn each case into one Python exception.

use std::fmt;

/// An error of the expression core, in the user's own names.
#[derive(Clone, Debug, PartialEq)]
pub enum Error {
    /// A divisor is identically zero; holds the dividend.
    DivisionByZero(String),
    /// A double is infinite or not a number.
    NotFinite(f64),
    /// The exact value of a power would fill the memory.
    NumberTooLarge(String),
    /// A function was called with the wrong number of arguments.
    Arity {
        /// The name of the function.
        function: &'static str,
        /// The number of arguments that it takes, in words.
        expected: &'static str,
        /// The number that was found.
        found: usize,
    },
    /// A function was applied to an exact argument outside its domain.
    Domain {
        /// The name of the function.
        function: &'static str,
        /// The argument.
        argument: String,
    },
    /// A function that orders real numbers was applied to what depends on complex symbols.
    Order {
        /// The name of the function.
        function: &'static str,
        /// The argument.
        argument: String,
        /// A complex symbol that it contains.
        symbol: String,
    },
    /// A modulus or a sign has no derivative, because its argument may be complex.
    NoDerivative {
        /// The modulus or the sign.
        expression: String,
        /// A complex symbol that it contains.
        symbol: String,
    },
    /// The shapes of two matrices do not match.
    Shape {
        /// The operation that was requested.
        operation: &'static str,
        /// Rows and columns of the first matrix.
        left: (usize, usize),
        /// Rows and columns of the second matrix.
        right: (usize, usize),
    },
    /// The equations do not determine their unknowns.
    Singular(String),
    /// An equation is not linear in an unknown.
    NotLinear {
        /// The left side of the equation.
        equation: String,
        /// The unknown in which it is not linear.
        unknown: String,
    },
    /// A request exceeds a stated limit.
    Limit {
        /// The quantity that is limited.
        what: &'static str,
        /// The limit.
        limit: usize,
        /// The number that was found; the largest one stands for all beyond it.
        found: usize,
    },
    /// Something that is not a variable was given as a variable of differentiation or substitution.
    NotAVariable(String),
    /// A derivative with respect to t that may be the total or the partial one.
    TwoTimeDerivatives {
        /// The expression.
        expression: String,
        /// A function of time that it contains.
        function: String,
    },
    /// An expression is singular where the variables of an expansion vanish.
    NoExpansion {
        /// The singular part of the expression.
        expression: String,
        /// The variables that vanish.
        variables: String,
    },
    /// An input of a compiled function has no value.
    MissingInput(String),
}

/// How many characters of an expression a message quotes: at its beginning and at its end.
const QUOTED: (usize, usize) = (51, 26);

/// Shorten a text for a message: a long one to its beginning and its end.
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
            Self::Order { function, argument, symbol } => write!(
                f,
                "{function} needs real numbers, and {argument} may be complex, because {symbol} is declared with real=False; \
                 take its modulus, or declare {symbol} without real=False"
            ),
            Self::NoDerivative { expression, symbol } => write!(
                f,
                "{expression} has no derivative where its argument is complex, and {symbol} is declared with real=False; \
                 declare {symbol} without real=False, or write the real and the imaginary part as real symbols"
            ),
            Self::Shape { operation, left, right } => write!(
                f,
                "{operation} of a {}x{} and a {}x{} matrix: the shapes do not match",
                left.0, left.1, right.0, right.1
            ),
            Self::Singular(text) | Self::MissingInput(text) => write!(f, "{text}"),
            Self::NotLinear { equation, unknown } => {
                write!(f, "the equation {equation} = 0 is not linear in {unknown}")
            }
            Self::Limit { what, limit, found: usize::MAX } => {
                write!(f, "{what}: at most {limit}, found more than can be counted")
            }
            Self::Limit { what, limit, found } => write!(f, "{what}: at most {limit}, found {found}"),
            Self::TwoTimeDerivatives { expression, function } => write!(
                f,
                "{expression} contains the function of time {function}, so it has two derivatives with respect to t: \
                 time_derivative(e) is the total one, partial_derivative(e, t) the one that holds {function} fixed"
            ),
            Self::NoExpansion { expression, variables } => write!(
                f,
                "{expression} has no expansion in small {variables}: it is singular, or 0/0, where small variables are \
                 zero; expand it at a regular value (1 + x for a variable near 1), or leave {variables} out of the \
                 small variables"
            ),
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
