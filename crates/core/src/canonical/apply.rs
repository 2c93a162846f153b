//! Functions applied to arguments: parity, exact values, and the value at the random point.

use std::cmp::Ordering;

use crate::error::Error;
use crate::evaluate::Pending;
use crate::graph::{
    Assumption, Flags, Function, Graph, Id, Kind, LONGEST, NumberId, Parity, View, check_order,
};
use crate::print::compare_names;
use crate::value::Number;

/// The most nodes of a term that are searched for names, because arguments may be graphs of any size.
const NAMES_SEARCH: usize = 64;

impl Graph {
    /// A function of the table applied to arguments.
    ///
    /// # Errors
    /// If the number of arguments is wrong, or the function is not defined at them.
    pub fn apply(&mut self, function: Function, args: &[Id]) -> Result<Id, Error> {
        function.check_arity(args.len())?;
        check_count(args.len())?;
        let mut args: Vec<Id> = args.iter().map(|&id| self.adopt(id)).collect();
        if function != Function::Piecewise {
            let by_numbers = function.is_decided_by_numbers();
            let settle = |arg| if by_numbers { self.decided(arg) } else { self.settled(arg) };
            args = args.into_iter().map(settle).collect();
        }
        self.check_order(function, &args)?;
        if let Some(exact) = self.exact_value(function, &args)?
            && self.keeps_value_of_function(function, &args, exact)
        {
            return Ok(exact);
        }
        if let Some(result) = self.by_parity(function, &args)? {
            return Ok(result);
        }
        if function == Function::Tan && self.is_pole_of_tangent(args[0]) {
            let argument = self.to_quotation(args[0]);
            return Err(Error::Domain { function: function.name(), argument });
        }
        let words: Vec<u32> = args.iter().map(|id| id.0).collect();
        let kind = Kind::Function(function);
        let (flags, value) = match self.row(kind, &words) {
            Some(known) => (self.flags(known), self.value(known)),
            None => (self.flags_of_function(function, &args), self.function_fingerprint(function, &args)),
        };
        Ok(self.finish(kind, flags, &words, value))
    }

    /// The undefined function `name` of arguments, differentiated `orders[i]` times by argument i.
    ///
    /// # Errors
    /// If there are too many arguments, a number of orders that differs from theirs, or too many derivatives.
    pub fn application(&mut self, name: &str, args: &[Id], orders: &[u32]) -> Result<Id, Error> {
        check_count(args.len())?;
        if args.len() != orders.len() {
            let (left, right) = ((args.len(), 1), (orders.len(), 1));
            return Err(Error::Shape { operation: "differentiation", left, right });
        }
        check_order(orders.iter().copied().map(u64::from).sum())?;
        if let ([arg], [order]) = (args, orders)
            && self.kind(*arg) == Kind::Time
        {
            return self.time_function(name, *order);
        }
        let name_id = self.name_id(name);
        let flags = args.iter().fold(Flags::default(), |flags, &arg| flags.join(self.flags(arg)));
        let value = self.application_fingerprint(name, args, orders);
        let words: Vec<u32> = std::iter::once(name_id)
            .chain(args.iter().map(|id| id.0))
            .chain(orders.iter().copied())
            .collect();
        Ok(self.finish(Kind::Application, flags, &words, value))
    }

    /// Check that functions that order real numbers do not get complex ones.
    fn check_order(&self, function: Function, args: &[Id]) -> Result<(), Error> {
        let place = match function {
            Function::Min | Function::Max | Function::Atan2 => {
                args.iter().copied().find(|&id| self.is_complex(id))
            }
            Function::Piecewise => {
                args[..args.len() - 1].iter().skip(1).step_by(2).copied().find(|&id| self.is_complex(id))
            }
            _ => None,
        };
        let Some(id) = place else { return Ok(()) };
        let function =
            if function == Function::Piecewise { "the condition of Piecewise" } else { function.name() };
        Err(Error::Order { function, argument: self.to_quotation(id), symbol: self.complex_symbol(id) })
    }

    /// The text of the first complex symbol below a node.
    pub(crate) fn complex_symbol(&self, id: Id) -> String {
        let mut symbols = self.variables(&[id]).into_iter();
        let complex = symbols.find(|&id| matches!(self.kind(id), Kind::Symbol(Assumption::None)));
        complex.map_or_else(String::new, |id| self.to_text(id))
    }

    /// f(-x) = -f(x) or f(x): choose the sign of the argument so that its first term, as printed, is positive. Terms
    /// with functions of time count as the first ones: `q - omega*t`.
    fn by_parity(&mut self, function: Function, args: &[Id]) -> Result<Option<Id>, Error> {
        let parity = function.parity();
        if parity == Parity::Neither || !self.reads_negative(args[0]) {
            return Ok(None);
        }
        let argument = self.opposite(args[0]);
        let result = self.apply(function, &[argument])?;
        Ok(Some(if parity == Parity::Odd { self.scale(NumberId::MINUS_ONE, result) } else { result }))
    }

    /// Whether the first term, as printed, is negative: `b - a` counts as -(a - b), because names are ordered.
    fn reads_negative(&self, id: Id) -> bool {
        match self.view(id) {
            View::Number(number) => self.get_number(number).is_negative(),
            View::Scale(factor, child) => self.get_number(factor).is_negative() != self.reads_negative(child),
            View::Sum(terms) if terms.len() > NAMES_SEARCH => false,
            View::Sum(terms) => {
                let first = terms.iter().min_by(|a, b| {
                    let by_motion = self.is_given(a.1).cmp(&self.is_given(b.1));
                    by_motion.then_with(|| compare_name_lists(&self.names(a.1), &self.names(b.1)))
                });
                first.is_some_and(|(factor, _)| self.get_number(factor).is_negative())
            }
            _ => false,
        }
    }

    /// Whether no function of time is near the top of a node.
    fn is_given(&self, id: Id) -> bool {
        let (mut stack, mut visited) = (vec![id], 0);
        while let Some(id) = stack.pop().filter(|_| visited < NAMES_SEARCH) {
            visited += 1;
            match self.view(id) {
                View::TimeFunction(..) => return false,
                _ => self.push_children(id, &mut stack),
            }
        }
        true
    }

    /// The names of the variables near the top of a node, in the reader's order.
    fn names(&self, id: Id) -> Vec<&str> {
        let (mut names, mut stack, mut visited) = (Vec::new(), vec![id], 0);
        while let Some(id) = stack.pop().filter(|_| visited < NAMES_SEARCH) {
            visited += 1;
            match self.view(id) {
                View::Symbol(name, _) | View::TimeFunction(name, ..) | View::Application { name, .. } => {
                    names.push(name);
                }
                View::Time => names.push("t"),
                _ => self.push_children(id, &mut stack),
            }
        }
        names.sort_by(|a, b| compare_names(a, b));
        names
    }

    /// Whether a rule has kept the value. Those of signs and moduli of roots, which may be complex in some lanes, need not,
    /// nor those that take pi from an angle that holds it elsewhere in a root, nor those that make another argument: it
    /// may be known in a form that has another value in the field of arguments.
    fn keeps_value_of_function(&self, function: Function, args: &[Id], result: Id) -> bool {
        let is_certain = match function {
            Function::Abs | Function::Sign => !self.flags(args[0]).has(Flags::BRANCH),
            Function::Sin | Function::Cos | Function::Tan => !self.flags(args[0]).has(Flags::INVERSE),
            Function::Exp => {
                !self.flags(args[0]).has(Flags::BRANCH) || !self.flags(args[0]).has(Flags::INVERSE)
            }
            Function::Power => self.kind(args[0]) != Kind::Function(Function::Exp),
            _ => true,
        };
        is_certain
            || self.function_fingerprint(function, args) == self.value(result)
                && self.agrees(Pending::Function(function, args), result, false)
    }

    /// Whether an angle is an odd multiple of pi/2 though it does not look like one.
    pub(super) fn is_pole_of_tangent(&self, angle: Id) -> bool {
        self.flags(angle).has(Flags::INVERSE)
            && self.function_fingerprint(Function::Cos, &[angle]).is_zero()
            && self.is_number_everywhere(Pending::Function(Function::Cos, &[angle]), &Number::integer(0))
    }

    /// The facts about a function of arguments that are not those of its arguments.
    fn flags_of_function(&self, function: Function, args: &[Id]) -> Flags {
        let flags = self.joined_flags(args.iter().copied());
        match function {
            Function::Abs | Function::Sign | Function::Min | Function::Max | Function::Piecewise => {
                flags.with(Flags::BRANCH)
            }
            Function::Atan2 => flags.with(Flags::BRANCH).with(Flags::INVERSE),
            Function::Asin | Function::Acos | Function::Atan | Function::Log => flags.with(Flags::INVERSE),
            Function::Sin | Function::Cos | Function::Tan if self.makes_roots(args[0], false) => {
                flags.with(Flags::BRANCH)
            }
            Function::Exp | Function::Sinh | Function::Cosh | Function::Tanh
                if self.makes_roots(args[0], true) =>
            {
                flags.with(Flags::BRANCH).with(Flags::UNITS)
            }
            Function::Power if self.is_branching_power(args[0], args[1]) => {
                flags.with(Flags::BRANCH).with(Flags::UNITS)
            }
            _ => flags,
        }
    }
}

/// Compare lists name by name; a list without names, of a constant, comes last.
fn compare_name_lists(a: &[&str], b: &[&str]) -> Ordering {
    let by_name = a.iter().zip(b).map(|(x, y)| compare_names(x, y)).find(|order| order.is_ne());
    a.is_empty().cmp(&b.is_empty()).then(by_name.unwrap_or(Ordering::Equal)).then(a.len().cmp(&b.len()))
}

/// The error for more than [`LONGEST`] arguments.
fn check_count(found: usize) -> Result<(), Error> {
    if found <= LONGEST {
        return Ok(());
    }
    Err(Error::Limit { what: "arguments of a function", limit: LONGEST, found })
}
