//! Tests of the crate from outside, in one program: linking one for each file takes longer than running them.
//! `memory.rs` is a program of its own, since it measures its process.

mod chapters;
mod depth;
mod factorization;
mod limits;
mod matrix;
mod positive_definite;
mod print;
mod rewrites;
mod simplify;
mod solve;
mod tape;
