//! Rewrites that a user asks for: expand, collect, factor, combine trigonometric products, simplify.
//!
//! A rewrite reads an expression as a polynomial ([`ring`] numbers the atoms, [`expand`] opens products and angles),
//! works on the polynomial, and builds nodes from it. [`simplify`] tries the others and keeps the shortest result.
//! Simplifications that always happen, such as `x + 0`, are not rewrites: they are in `canonical`.
//!
//! Invariant: a rewrite keeps the value at the random point. [`inside_out`] drops each step that doesn't.

mod addition_theorem;
mod angle_sum;
mod collect;
mod combine_trig;
mod content;
mod expand;
mod factor_terms;
mod flat_sums;
mod frame_angles;
mod inside_out;
mod parameter_factor;
mod pythagoras;
mod rational;
mod readable;
mod rectangle;
mod ring;
mod search;
mod shared_sums;
mod simplify;
mod trig_form;
