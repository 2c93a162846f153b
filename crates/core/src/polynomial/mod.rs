//! Polynomials with exact coefficients, in atoms that are known by number: the algebra below the rewrites.
//!
//! Nothing here knows the graph: `rewrite::ring` says which node an atom stands for.
//!
//! Invariant: a polynomial has at most one term per monomial, and no term has the coefficient zero. Operations that may
//! make many terms spend a [`Budget`], and fail when it is spent.

mod monomial;
mod sparse;

pub(crate) use monomial::Monomial;
pub(crate) use sparse::{Budget, Polynomial};
