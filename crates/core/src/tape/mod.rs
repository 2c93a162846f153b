//! Tapes: expressions as straight-line code in doubles, evaluated here and printed as source code elsewhere.
//!
//! [`lower`] translates nodes into the instructions of [`straight_line`], [`schedule`] orders them, [`stage`] sorts
//! them by how often their inputs change, and [`eval`] runs them.
//!
//! Invariant: an instruction reads inputs, constants and earlier values only, and every value that is computed is used.

mod coefficient;
mod emit;
mod eval;
mod extended_product;
mod linear_systems;
mod lower;
mod reciprocal;
mod schedule;
mod sign;
mod stage;
mod straight_line;

pub use eval::{Column, Evaluator};
pub use stage::Staged;
pub use straight_line::{Factorization, Instruction, Operand, Registers, Solution, Tape};
