//! Simplest forms that were found, and what they took: a cache of `rewrite::simplify`.

use super::Id;

/// A part, and how many levels of coefficients within coefficients are simplified on their own.
pub(crate) type Part = (Id, usize);

/// The simplest form of a part, found with work to spare.
#[derive(Clone, Debug)]
pub(crate) struct SimplestForm {
    pub(crate) form: Id,
    /// The work for the part, without that for others.
    pub(crate) work: usize,
    /// The parts whose simplest forms were asked for.
    pub(crate) others: Vec<Part>,
}
