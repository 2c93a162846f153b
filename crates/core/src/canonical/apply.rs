//! Functions applied to arguments: parity, exact values, and the value at the random point.

use std::cmp::Ordering;

use crate::error::Error;
use crate::graph::{Flags, Function, Graph, Id, Kind, LONGEST, NumberId, Parity, View, check_order};
use crate::print::compare_names;
use crate::value::{Element, Key, Number};

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
        let args: Vec<Id> = args.iter().map(|&id| self.adopt(id)).collect();
        if let Some(exact) = self.exact_value(function, &args)? {
            return Ok(exact);
        }
        if let Some(result) = self.by_parity(function, &args)? {
            return Ok(result);
        }
        let value = self.function_value(function, &args);
        let flags = self.joined_flags(args.iter().copied());
        let words: Vec<u32> = args.iter().map(|id| id.0).collect();
        Ok(self.finish(Kind::Function(function), flags, &words, value))
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
        let mut key = Key::new("application").text(name);
        let mut flags = Flags::default();
        for (&arg, &order) in args.iter().zip(orders) {
            key = key.element(self.value(arg)).word(order.into());
            flags = flags.join(self.flags(arg));
        }
        let words: Vec<u32> = std::iter::once(name_id)
            .chain(args.iter().map(|id| id.0))
            .chain(orders.iter().copied())
            .collect();
        Ok(self.finish(Kind::Application, flags, &words, Element::draw(&key)))
    }

    /// f(-x) = -f(x) or f(x): choose the sign of the argument so that its first term, as printed, is positive.
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
                let first =
                    terms.iter().min_by(|a, b| compare_name_lists(&self.names(a.1), &self.names(b.1)));
                first.is_some_and(|(factor, _)| self.get_number(factor).is_negative())
            }
            _ => false,
        }
    }

    /// The names of the variables near the top of a node, in the reader's order.
    fn names(&self, id: Id) -> Vec<&str> {
        let (mut names, mut stack, mut visited) = (Vec::new(), vec![id], 0);
        while let Some(id) = stack.pop().filter(|_| visited < NAMES_SEARCH) {
            visited += 1;
            match self.view(id) {
                View::Symbol(name, _) | View::TimeFunction(name, _) | View::Application { name, .. } => {
                    names.push(name);
                }
                View::Time => names.push("t"),
                _ => self.push_children(id, &mut stack),
            }
        }
        names.sort_by(|a, b| compare_names(a, b));
        names
    }

    /// The value at the random point: by the group laws where there are any; opaque functions have drawn values.
    fn function_value(&mut self, function: Function, args: &[Id]) -> Element {
        let first = args[0];
        let half = || Element::from_number(&Number::rational(1, 2));
        match function {
            Function::Sin => self.circle(first).sin,
            Function::Cos => self.circle(first).cos,
            Function::Tan => {
                let point = self.circle(first);
                point.sin * point.cos.inverse()
            }
            Function::Exp => self.exponential(first),
            Function::Sinh | Function::Cosh | Function::Tanh => {
                let exponential = self.exponential(first);
                let inverse = exponential.inverse();
                let (sinh, cosh) = (exponential - inverse, exponential + inverse);
                match function {
                    Function::Sinh => sinh * half(),
                    Function::Cosh => cosh * half(),
                    _ => sinh * cosh.inverse(),
                }
            }
            Function::Power => self.general_power(first, args[1]),
            Function::Piecewise => self.piecewise_value(args),
            Function::Acos => {
                // acos x = pi/2 - asin x
                let quarter = Element::draw(&Key::new("pi")) * half();
                quarter - self.opaque_value(Function::Asin, args)
            }
            _ => self.opaque_value(function, args),
        }
    }

    /// The values of real functions that derive from the modulus: |u| is the root of u^2, in whatever form.
    ///
    /// sign u = u/|u|, max(a, b) = (a + b + |a - b|)/2, min(a, b) = (a + b - |a - b|)/2.
    fn value_by_modulus(&self, function: Function, args: &[Id]) -> Option<Element> {
        let modulus = |value: Element| {
            let key = Key::new("root").element(value.powi(2));
            Element::draw_exponential(&key).pow_rational(&Number::rational(1, 2))
        };
        let first = self.value(args[0]);
        match (function, args) {
            (Function::Abs, _) => Some(modulus(first)),
            (Function::Sign, _) => Some(first * modulus(first).inverse()),
            (Function::Min | Function::Max, &[_, second]) => {
                let second = self.value(second);
                let distance = modulus(first - second);
                let sum = first + second;
                let twice = if function == Function::Max { sum + distance } else { sum - distance };
                Some(twice * Element::from_i64(2).inverse())
            }
            _ => None,
        }
    }

    /// The sum of the branches times indicators of the first positive condition.
    ///
    /// Indicators are drawn for the values of the conditions. So the derivative of a piecewise function has the same
    /// value by branches and by partial derivatives.
    fn piecewise_value(&self, args: &[Id]) -> Element {
        let (mut value, mut not_yet) = (Element::ZERO, Element::ONE);
        for pair in args[..args.len() - 1].chunks_exact(2) {
            let positive = Element::draw(&Key::new("indicator").element(self.value(pair[1])));
            value = value + not_yet * positive * self.value(pair[0]);
            not_yet = not_yet * (Element::ONE - positive);
        }
        value + not_yet * self.value(args[args.len() - 1])
    }

    /// A value drawn for the function and the values of its arguments, with the parity of the function.
    fn opaque_value(&self, function: Function, args: &[Id]) -> Element {
        if args.iter().all(|&arg| self.is_real(arg))
            && let Some(value) = self.value_by_modulus(function, args)
        {
            return value;
        }
        let parity = function.parity();
        let key = Key::new("function").text(function.name());
        if parity == Parity::Neither {
            return Element::draw(&args.iter().fold(key, |key, &id| key.element(self.value(id))));
        }
        let (argument, negated) = self.value(args[0]).unsigned();
        let value = Element::draw(&key.element(argument));
        if negated && parity == Parity::Odd { -value } else { value }
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
