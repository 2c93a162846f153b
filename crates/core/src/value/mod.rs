//! Numbers: the exact ones that expressions hold, and the elements of finite fields that expressions have as values.
//!
//! A [`Number`] is a fraction of integers of any size. An [`Element`] is the fingerprint of an expression: its values in
//! the two hash [lanes](lane). A lane is a random point over a finite field, drawn from [`Key`]s of names, so that a
//! value never depends on the order of construction. [`Quadratic`] is the value in any lane of what holds roots.
//!
//! Invariant: sums, products and quotients of elements are the elements of the sums, products and quotients of numbers,
//! except for the rare numbers that are multiples of a prime: these have drawn elements.

mod adic;
mod circle;
mod coefficient;
mod double;
mod element;
mod exact_angle;
mod extended;
mod field;
mod gcd;
mod groups;
mod key;
mod lane;
mod lanes;
mod likely_number;
mod number;
mod odd_root;
mod prime;
mod quadratic;
mod radical;
mod rational_power;
mod unramified;
mod unramified_root;

pub(crate) use adic::{Adic, Adics};
pub(crate) use coefficient::Coefficient;
pub use element::Element;
pub(crate) use exact_angle::needs_large_products;
pub(crate) use field::Field;
pub(crate) use key::Key;
pub(crate) use lane::{FieldId, fingerprint, in_hash_lane};
pub(crate) use lanes::LARGEST_SQUARE;
pub(crate) use likely_number::likely_number;
pub use number::Number;
pub(crate) use quadratic::Quadratic;
pub(crate) use radical::{coprime_factors, prime_factors};
pub(crate) use unramified::{Extension, Unramified};
pub(crate) use unramified_root::DEGREES as ROOT_DEGREES;
