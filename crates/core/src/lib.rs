//! The expression graph of symbody.

mod calculus;
mod canonical;
mod error;
mod graph;
mod kernel;
mod linear;
mod polynomial;
mod print;
mod rewrite;
mod tape;
mod value;

pub use canonical::{check_rows, multiple_of_pi};
pub use error::{Error, quoted};
pub use graph::{
    Assumption, Classes, Cost, Factors, Function, Graph, Id, Ids, LARGEST_ORDER, NumberId, Terms, View,
};
pub use kernel::{Deficiency, contradiction, factorization, positive_definite};
pub use linear::{Matrix, vector};
pub use print::{Format, Listing};
pub use tape::{Column, Evaluator, Factorization, Instruction, Operand, Registers, Solution, Staged, Tape};
pub use value::{Element, Number};
pub use vector::Vector3;
