//! Derivatives and substitution.
//!
//! [`diff`] has forward derivatives by a variable or by time, and gradients by one reverse sweep; [`partial`] has the
//! rule for each kind of node, [`linear_system`] those for solutions of linear systems; [`substitute`] replaces whatever
//! has the value of a target; [`congruent`] sees to it that both give equal results for equal expressions, and
//! [`vanishing`] finds derivatives that are zero by value;
//! [`expansion`] drops terms of high degree in small variables, by the arithmetic of [`series`]; [`idle`] replaces
//! variables on which a value does not depend.
//!
//! Invariant: each node below the roots is visited once, so that the time is linear in the size of the graph, and no
//! function is recursive in its depth.

mod congruent;
mod diff;
mod expansion;
mod idle;
mod linear_system;
mod partial;
mod series;
mod substitute;
mod vanishing;
