//! The value graph: one append-only table of nodes, each with its exact value at the random point.
//!
//! [`Graph`] stores nodes and reads them; [`View`] shows one node with its parts; [`Function`] is the table of
//! elementary functions; [`Classes`] is the memory of a derivation; [`Cost`] counts operations.
//!
//! Invariants: nodes are never changed or removed; equal rows are one node; a node comes after its children. Nothing
//! here decides which form an expression takes: sums, products and functions are made in `canonical`.

mod by_value;
mod classes;
mod cost;
mod function;
mod lanes;
mod node;
mod real_range;
mod representatives;
mod simplest_form;
mod table;
mod traverse;

pub(crate) use by_value::ByValue;
pub use classes::Classes;
pub use cost::Cost;
pub(crate) use cost::{factoring, solving};
pub use function::Function;
pub(crate) use function::Parity;
pub(crate) use lanes::{
    Atom, Coin, Column, Combination, Content, Generator, Monomial, Signs, Split, draw_logarithm, leaf_in,
};
pub use node::{Assumption, Factors, Id, Ids, NumberId, Terms, View};
pub(crate) use node::{Flags, Kind};
pub(crate) use real_range::RealRange;
pub(crate) use representatives::Standing;
pub(crate) use simplest_form::{Part, SimplestForm};
pub use table::{Graph, LARGEST_ORDER};
pub(crate) use table::{LONGEST, check_order, word};
pub(crate) use traverse::children_first;
