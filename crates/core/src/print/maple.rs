//! Maple's one-dimensional notation, as its `lprint` writes it.

use crate::graph::Function;

use super::linear::Dialect;
use super::name;

pub(super) struct Maple;

impl Dialect for Maple {
    const PLUS: &str = "+";
    const MINUS: &str = "-";
    const POWER: &str = "^";
    const COMMA: &str = ",";
    const PI: &str = "Pi";

    fn name(&self, name: &str) -> String {
        name::to_maple(name)
    }

    fn time_function(&self, name: &str, order: u32, _explicit: bool) -> String {
        let name = name::to_maple(name);
        match order {
            0 => format!("{name}(t)"),
            1 => format!("diff({name}(t),t)"),
            _ => format!("diff({name}(t),`$`(t,{order}))"),
        }
    }

    fn function_name(&self, function: Function) -> &'static str {
        match function {
            Function::Asin => "arcsin",
            Function::Acos => "arccos",
            Function::Atan | Function::Atan2 => "arctan",
            Function::Log => "ln",
            Function::Abs => "abs",
            Function::Sign => "signum",
            Function::Min => "min",
            Function::Max => "max",
            Function::Piecewise => "piecewise",
            _ => function.name(),
        }
    }

    fn branch(&self, value: &str, condition: Option<&str>) -> String {
        match condition {
            Some(condition) => format!("0 < {condition},{value}"),
            None => value.to_owned(),
        }
    }
}
