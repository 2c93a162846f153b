//! Which values a node may have for real variables.

/// The values that a node may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum RealRange {
    /// Complex ones, too.
    Any,
    Real,
    /// Real ones that are not negative.
    NotNegative,
}
