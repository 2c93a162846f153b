//! Linear algebra on expressions: matrices, vectors, determinants and systems that are solved in symbols.
//!
//! [`form`] reads equations as linear in the unknowns, [`block`] finds the smallest systems that can be solved one
//! after another, [`rank`] finds equations that follow from others, and [`solve`] applies Cramer's rule to each block
//! with the minors of [`minor`].
//!
//! Invariant: no symbolic pivot divides anything. Ranks and zeros are decided by values at the random point. Systems
//! that are solved at run time are nodes: `canonical/linear_system.rs`.

mod block;
mod content;
mod form;
mod matrix;
mod minor;
mod rank;
mod solve;
pub mod vector;

pub use matrix::Matrix;
