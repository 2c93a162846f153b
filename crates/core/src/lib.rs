//! The expression graph of symbody.
//!
//! Every node knows its exact value at a random point of a finite field, so equal mathematics is one
//! node and zero is seen when it is made. No Python, no mechanics, no global state.

mod addition_theorem;
mod angle;
mod angle_sum;
mod apply;
mod associate;
mod block;
mod build;
mod classes;
mod collect;
mod collector;
mod combine_trig;
mod content;
mod cost;
mod diff;
mod distribute;
mod emit;
mod error;
mod eval;
mod exact;
mod expand;
mod factor_terms;
mod field;
mod function;
mod graph;
mod inside_out;
mod linear;
mod lower;
mod matrix;
mod minor;
mod monomial;
mod node;
mod number;
mod polynomial;
mod print;
mod product;
mod pythagoras;
mod rank;
mod rational;
mod ring;
mod root;
mod schedule;
mod sign;
mod simplify;
mod solve;
mod substitute;
mod sum;
mod tape;
mod traverse;
mod trig_form;
pub mod vector;

pub use classes::Classes;
pub use cost::Cost;
pub use error::Error;
pub use eval::{Column, Evaluator};
pub use field::Element;
pub use function::Function;
pub use graph::Graph;
pub use matrix::Matrix;
pub use node::{Assumption, Factors, Id, Ids, NumberId, Terms, View};
pub use number::Number;
pub use print::{Format, Listing};
pub use tape::{Instruction, Operand, Registers, Tape};
pub use vector::Vector3;
