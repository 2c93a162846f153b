//! The value graph of symbody: symbolic expressions in which equal mathematics is one node.
//!
//! # What a value graph is
//!
//! A [`Graph`] is a table of expressions. Each row is a *node*: a number, a symbol, a function of time, or a sum, a
//! product or a function of earlier nodes. An [`Id`] is the number of a row, and [`Graph::view`] shows what the row
//! holds. Expressions share their parts, so an expression that takes megabytes when it is written out may be a few
//! hundred nodes.
//!
//! Each node carries its *fingerprint*: the result of evaluating it exactly in two *lanes*, which are random points
//! over finite fields. Every symbol has fixed coordinates there, derived from its name. Sines and cosines take points
//! of the circle group, so that addition theorems hold exactly. Exponentials, and symbols that are positive, take
//! members of a group in which every root exists. The value of a function of u depends on the value of u alone, so what
//! is equal by these laws stays equal inside functions. The fields have primes near 2^63: two different rational
//! expressions of degree d have equal values with a probability of at most about (d / 2^63)^2, 1e-32 for a degree of
//! 1000 [Schwartz 1980; Gonnet 1984]. Hence equality compares two values without any simplification, and a zero is
//! recognised when it is made:
//!
#![doc = "```"]
#![doc = include_str!("../tests/laws/first_example.rs")]
#![doc = "```"]
//!
//! The sign of a value is its quadratic character: whether it is a square. Roots of what is no square lie in larger
//! fields. In one lane the sign of a symbol is as random as a coin, so nodes that hold signs or roots are found by
//! their fingerprints and compared in 64 lanes, on demand.
//!
//! # Invariants
//!
//! * The table only grows. Nodes are never changed or removed, and a node comes after its children.
//! * Equal rows are one node. Sums, products and functions enter the table through one function, which is in the
//!   module `canonical::build`. It returns a number for a row that has the value of zero or of another simple
//!   number.
//! * The value of a node is the value of the mathematics that it shows, and in each lane it depends on the values of
//!   its children alone. What has no law in the field, such as `log(x*y)`, is drawn for the values of its arguments: it
//!   equals itself, and the same function of equal arguments. (`docs/values.md` has the exceptions that remain.)
//! * A form never changes a value: a rule by form that would is not applied.
//! * Within a derivation ([`Graph::enter`], [`Graph::leave`]) a node whose value is known is not made again, so that
//!   two derivations of one quantity meet in one node.
//! * Results depend on the arguments alone: never on ids, addresses, the order of a hash table, or what else the
//!   process has computed.
//! * Traversals are loops, not recursions, because graphs may be 100 000 levels deep.
//! * Mistakes of the user are an [`Error`]. A panic is an error of this crate.
//!
//! # The chapters
//!
//! The sources lie in folders, from the lowest to the highest. A chapter uses only chapters before it
//! (`tests/laws/chapters.rs` checks this).
//!
//! | chapter | what lives there |
//! |---|---|
//! | `value` | exact numbers, and the finite fields of the lanes |
//! | `polynomial` | sparse polynomials with exact coefficients |
//! | `kernel` | linear systems in doubles |
//! | `graph` | the table of nodes, the table of functions, orders of traversal, operation counts |
//! | `evaluate` | the exact values of nodes in the lanes, and equality |
//! | `print` | plain text, LaTeX, Maple |
//! | `canonical` | the constructors: here `x + 0` becomes `x` |
//! | `tape` | straight-line code in doubles, and its evaluation |
//! | `calculus` | derivatives, gradients, substitution |
//! | `rewrite` | expand, collect, factor, combine, simplify: the rewrites that a user asks for |
//! | `linear` | matrices, vectors, linear systems in symbols |
//!
//! No Python, no mechanics, no global state but the watch of a thread over its long work ([`interruptible`]).

#![warn(missing_docs)]

mod calculus;
mod canonical;
mod error;
mod evaluate;
mod graph;
mod interrupt;
mod kernel;
mod linear;
mod polynomial;
mod print;
mod rewrite;
mod tape;
mod value;

// The tests from outside are compiled with those of the files: the crate takes the longest of all to compile.
#[cfg(test)]
extern crate self as symbody_core;
#[cfg(test)]
#[path = "../tests/laws/mod.rs"]
mod laws;

// Expressions: the graph and what it shows. The operations are methods of `Graph`.
pub use graph::{Assumption, Classes, Cost, Graph, Id, LARGEST_ORDER, View};
pub use graph::{Factors, Function, Ids, NumberId, Terms};
pub use value::{Element, Number};

// What can go wrong, and how messages quote an expression.
pub use error::{Error, quoted};

// Long work that someone waits for.
pub use interrupt::{Interrupted, interruptible};

// Text.
pub use print::{Format, Listing, Usage};

// Linear algebra on expressions, and in doubles.
pub use canonical::check_rows;
pub use kernel::{Deficiency, FACTORIZATION_SOURCE, contradiction, factorization, positive_definite};
pub use linear::{Matrix, vector};
pub use vector::Vector3;

// Angles that are doubles.
pub use canonical::multiple_of_pi;

// Straight-line code.
pub use tape::{Column, Evaluator, Factorization, Instruction, Operand, Registers, Solution, Staged, Tape};
