//! Motions from compiled equations: the loop of an integration, without an interpreter.
//!
//! Functions are machine code at given addresses ([`BoundCode`]). A stepper advances the state. After each step the
//! state is projected onto the constraints, events are located, and the states at the requested instants are read
//! from the dense output. [`integrate()`] runs one motion, and [`integrate_many`] runs many in several threads.
//!
//! The methods are rows of a table in `method`: the [`Method`], its name, and the family that advances it. An explicit
//! Runge–Kutta method is a file of coefficients in `runge_kutta` and a row. A method of another kind is a file with a
//! `Stepper`, a `Family`, its line in `start`, and a row.

mod batch;
mod branch;
mod crew;
mod diffsol_methods;
mod dynamics;
mod energy_balance;
mod event;
mod excursion;
mod failure;
mod integrate;
mod lane;
mod machine_code;
mod method;
mod part;
mod projection;
mod runge_kutta;
mod start;
mod stepper;
mod thinned;
mod tolerances;
mod trail;

pub use batch::{Case, integrate_many};
pub use dynamics::{Dynamics, EventKind};
pub use energy_balance::Imbalance;
pub use event::Occurrence;
pub use failure::Failure;
pub use integrate::{Record, Run, integrate};
pub use machine_code::{BoundCode, MachineCode};
pub use method::Method;
pub use runge_kutta::{Row, Tableau};
pub use stepper::Statistics;
pub use tolerances::Tolerances;
