//! The table of the methods of integration.

use crate::diffsol_methods::Formula;
use crate::runge_kutta::{DOP853, TSIT5, Tableau};

/// A method of integration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// The explicit Runge–Kutta method of order 8 by Dormand and Prince.
    Dop853,
    /// The explicit Runge–Kutta method of order 5 by Tsitouras.
    Tsit5,
    /// Backward differentiation formulae of variable order.
    Bdf,
    /// A singly diagonally implicit Runge–Kutta method of order 3.
    Esdirk34,
    /// The trapezoidal rule with a backward differentiation formula, of order 2.
    TrBdf2,
}

/// What advances a state by a method.
#[derive(Clone, Copy)]
pub enum Family {
    /// The explicit Runge–Kutta method with these coefficients.
    RungeKutta(&'static Tableau),
    /// An implicit method of the library diffsol.
    Diffsol(Formula),
}

/// A row of the table.
struct Entry {
    method: Method,
    name: &'static str,
    family: Family,
}

const fn entry(method: Method, name: &'static str, family: Family) -> Entry {
    Entry { method, name, family }
}

const TABLE: [Entry; 5] = [
    entry(Method::Dop853, "dop853", Family::RungeKutta(&DOP853)),
    entry(Method::Tsit5, "tsit5", Family::RungeKutta(&TSIT5)),
    entry(Method::Bdf, "bdf", Family::Diffsol(Formula::Bdf)),
    entry(Method::Esdirk34, "esdirk34", Family::Diffsol(Formula::Esdirk34)),
    entry(Method::TrBdf2, "tr_bdf2", Family::Diffsol(Formula::TrBdf2)),
];

// `Method::family` finds the row of a method at its place.
const _: () = {
    let mut place = 0;
    while place < TABLE.len() {
        assert!(TABLE[place].method as usize == place);
        place += 1;
    }
};

impl Method {
    /// The method with a name.
    pub fn named(name: &str) -> Option<Self> {
        TABLE.iter().find(|entry| entry.name == name).map(|entry| entry.method)
    }

    /// Whether it needs the Jacobian.
    pub fn is_implicit(self) -> bool {
        matches!(self.family(), Family::Diffsol(_))
    }

    /// The coefficients of an explicit method, which motions can take in lock-step.
    pub fn tableau(self) -> Option<&'static Tableau> {
        match self.family() {
            Family::RungeKutta(tableau) => Some(tableau),
            Family::Diffsol(_) => None,
        }
    }

    pub(crate) const fn family(self) -> Family {
        TABLE[self as usize].family
    }
}
