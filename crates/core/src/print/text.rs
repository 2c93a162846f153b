//! Plain text that parses back: `m*x'' + 2*sin(q)**2`.

use crate::graph::Function;

use super::Fractions;
use super::linear::Dialect;

pub(super) struct Text {
    pub(super) fractions: Fractions,
}

/// Beyond this order a derivative is written `diff(x, t, 4)`: primes are no longer counted at a glance.
const PRIMES: u32 = 3;

impl Dialect for Text {
    const PLUS: &str = " + ";
    const MINUS: &str = " - ";
    const POWER: &str = "**";
    const COMMA: &str = ", ";
    const PI: &str = "pi";

    fn fractions(&self) -> Fractions {
        self.fractions
    }

    fn name(&self, name: &str) -> String {
        name.to_owned()
    }

    fn time_function(&self, name: &str, order: u32, explicit: bool) -> String {
        let argument = if explicit { "(t)" } else { "" };
        if order > PRIMES {
            return format!("diff({name}{argument}, t, {order})");
        }
        format!("{name}{}{argument}", "'".repeat(order as usize))
    }

    fn function_name(&self, function: Function) -> &'static str {
        function.name()
    }

    fn branch(&self, value: &str, condition: Option<&str>) -> String {
        match condition {
            Some(condition) => format!("({value}, {condition} > 0)"),
            None => format!("({value}, True)"),
        }
    }
}
