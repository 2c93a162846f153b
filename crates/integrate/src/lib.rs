//! Motions from compiled equations: the loop of an integration, with no interpreter in it.
//!
//! Functions are machine code, known by their addresses. A stepper carries the state on; after each step the state is
//! put back onto the constraints, events are located, and the asked instants are read from the dense output.

mod balance;
mod batch;
mod branch;
mod dynamics;
mod event;
mod failure;
mod integrate;
mod library;
mod machine_code;
mod method;
mod projection;
mod runge_kutta;
mod start;
mod stepper;
mod trail;

pub use balance::Imbalance;
pub use batch::{Case, integrate_many};
pub use dynamics::{Dynamics, EventKind};
pub use event::Occurrence;
pub use failure::Failure;
pub use integrate::{Record, Run, integrate};
pub use machine_code::{BoundCode, MachineCode};
pub use method::{Method, Tolerances};
pub use stepper::Statistics;
