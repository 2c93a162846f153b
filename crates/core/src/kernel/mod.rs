//! Linear systems in doubles: what evaluated and generated code calls at run time.
//!
//! [`positive_definite`] tries elimination without pivoting; [`factorization`] takes any square matrix, pivots, and
//! gives the minimum-norm solution where the matrix is singular. [`contradiction`] and [`Deficiency`] say which
//! equations of a singular system follow from others, and which contradict them.
//!
//! Invariant: nothing here allocates while it factors or solves, and nothing uses the rest of the crate.
//! Generated Rust code contains `factorization.rs` as text ([`FACTORIZATION_SOURCE`]), so that file is complete without
//! this crate; its tests are in `tests/factorization.rs`.

pub mod contradiction;
mod deficiency;
pub mod factorization;
pub mod positive_definite;

pub use deficiency::Deficiency;

/// The source of [`factorization`]: generated Rust code solves its linear systems with it.
pub const FACTORIZATION_SOURCE: &str = include_str!("factorization.rs");
