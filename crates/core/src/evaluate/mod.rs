//! The exact values of nodes at the random points, and the equality that they decide.
//!
//! The law: *the value of f(u) depends on the value of u alone*, in each lane. So if A = B, then f(A) = f(B), whatever
//! the forms of A and B are. [`node`] has the value of each kind of node from those of its children, [`rational_power`]
//! that of roots, and [`solution`] that of linear systems; [`argument`] splits arguments of sines and exponentials into
//! what has a known angle or exponential and the rest; [`integer_point`] reads the factors of such parts off, by the mean
//! of [`conjugates`] where roots stand beside them; [`negative_base`] has powers of what may be negative; [`logarithm`]
//! knows logarithms of products, also of those that [`monomial`] finds; [`content`] is the numeric factor of a node, from
//! its [q-adic values](adic_value) at [points](adic_point); [`rotation`] adds angles, and [`length`] has the roots in them; [`complex`] tells what is real,
//! [`real_range`] what is nowhere negative, with [`semidefinite`] where forms do not show it, which opens [`polynomial`]s;
//! [`same`] compares nodes, in as many lanes as [`sign_degree`] and [`independent_signs`] say, unless their forms show that
//! they are equal ([`form`]). Functions are evaluated for the [`representative`] of all nodes of one value. [`slope`] finds
//! the variables on which a value depends.
//!
//! Invariant: nodes without signs and roots are compared in the two hash lanes, and others in all lanes. Values are
//! found by loops without recursion, except in arguments of functions inside arguments.

mod adic_point;
mod adic_value;
mod argument;
mod complex;
mod conjugates;
mod content;
mod drawn_argument;
mod drawn_root;
mod form;
mod independent_signs;
mod integer_point;
mod length;
mod logarithm;
mod logarithm_part;
mod monomial;
mod negative_base;
mod node;
mod pending;
mod polynomial;
mod rational_power;
mod real_range;
mod representative;
mod rotation;
mod same;
mod semidefinite;
mod sign_degree;
mod signs_in_argument;
mod slope;
mod solution;
mod values_at_integers;

pub(crate) use drawn_root::makes_units;
pub(crate) use pending::Pending;
