//! Numbers: the exact ones that expressions hold, and the elements of a finite field that expressions have as values.
//!
//! A [`Number`] is a fraction of integers of any size. An [`Element`] is a pair of residues modulo two primes of 62
//! bits: the value that an expression takes at a random point. Symbols, angles and exponents have points that are drawn
//! from a [`Key`] of their names and parts, so that a value never depends on the order of construction.
//!
//! Invariant: sums, products and quotients of elements are the elements of the sums, products and quotients of numbers,
//! except for the rare numbers that are multiples of a prime: these have drawn elements.

mod double;
mod field;
mod gcd;
mod number;
mod radical;

pub use field::Element;
pub(crate) use field::{Circle, Key, TORSION};
pub use number::Number;
pub(crate) use radical::{exact_root, radical_value, square_part};
