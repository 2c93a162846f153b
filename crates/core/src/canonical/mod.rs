//! Canonical forms: the constructors of sums, products, powers, functions and solutions.
//!
//! Every compound node is made here. A constructor brings its arguments into canonical form, computes the value at the
//! random point and hands both to [`build`], the only door into the table. So `x + 0` becomes `x` in [`sum`], `x*x/x`
//! becomes `x` in [`product`], `sin(pi/6)` becomes `1/2` in [`exact`], and whatever has the value zero becomes the
//! number 0 in [`build`].
//!
//! Invariant: equal arguments give one node, and the value of a node is the value of the mathematics that it shows.
//! Within a derivation, a node whose value is known is not made again ([`adopt`]).
//!
//! The files of this chapter call one another in circles, because the forms are defined in terms of one another: a sum
//! of equal terms is a product, a power of a product is a product of powers, and a function of a negative argument is a
//! multiple of a function. Who calls whom:
//!
//! * [`sum`] takes common factors out ([`distribute`]), which makes products.
//! * [`product`] sorts factors into a [`collector`], each by what leaves its base ([`power`]), takes roots of numbers out
//!   ([`root`]) and from roots ([`nested_root`]), merges moduli by [`apply`], groups factors ([`associate`]), and leaves
//!   numbers and signs to `scale` in [`sum`].
//! * [`apply`] looks for a simpler form ([`exact`]), which may be a sum, a product or another function. Values come from
//!   the chapter `evaluate`.
//! * [`linear_system`] adds and multiplies where it removes known components.
//! * [`adopt`], which all of them call for their arguments, calls [`rebuild`], and that the constructor of each kind.
//! * All end in [`build`], which calls none of them.

mod adopt;
mod apply;
mod associate;
mod build;
mod collector;
mod distribute;
mod drawn_roots;
mod exact;
mod hidden_number;
mod linear_system;
mod multiple_of_pi;
mod nested_root;
mod piecewise;
mod power;
mod product;
mod rebuild;
mod root;
mod sum;

pub use linear_system::check_rows;
pub use multiple_of_pi::multiple_of_pi;
