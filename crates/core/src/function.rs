//! The table of functions: name, arity, derivative, parity, exact values, field value, f64 value.

use crate::error::Error;
use crate::field::{Element, Key};
use crate::graph::Graph;
use crate::node::{Flags, Id, Kind, NumberId, View};
use crate::number::Number;

/// A function with a known derivative and a known numeric value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Function {
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    /// atan2(y, x)
    Atan2,
    Sinh,
    Cosh,
    Tanh,
    Exp,
    Log,
    Abs,
    /// -1, 0 or 1
    Sign,
    Min,
    Max,
    /// base ** exponent, the exponent no number
    Power,
    /// Piecewise(v1, c1, v2, c2, ..., otherwise): the first value whose condition is positive.
    Piecewise,
}

/// f(-x) in terms of f(x).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Parity {
    Odd,
    Even,
    Neither,
}

/// How many arguments a function takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Arity {
    Exactly(usize),
    AtLeast(usize),
    /// Pairs of value and condition, then the value otherwise.
    Pairs,
}

/// A row of the table.
struct Entry {
    function: Function,
    name: &'static str,
    arity: Arity,
    parity: Parity,
}

const fn entry(function: Function, name: &'static str, arity: Arity, parity: Parity) -> Entry {
    Entry { function, name, arity, parity }
}

use Arity::{AtLeast, Exactly, Pairs};
use Parity::{Even, Neither, Odd};

const TABLE: [Entry; 18] = [
    entry(Function::Sin, "sin", Exactly(1), Odd),
    entry(Function::Cos, "cos", Exactly(1), Even),
    entry(Function::Tan, "tan", Exactly(1), Odd),
    entry(Function::Asin, "asin", Exactly(1), Odd),
    entry(Function::Acos, "acos", Exactly(1), Neither),
    entry(Function::Atan, "atan", Exactly(1), Odd),
    entry(Function::Atan2, "atan2", Exactly(2), Neither),
    entry(Function::Sinh, "sinh", Exactly(1), Odd),
    entry(Function::Cosh, "cosh", Exactly(1), Even),
    entry(Function::Tanh, "tanh", Exactly(1), Odd),
    entry(Function::Exp, "exp", Exactly(1), Neither),
    entry(Function::Log, "log", Exactly(1), Neither),
    entry(Function::Abs, "Abs", Exactly(1), Even),
    entry(Function::Sign, "sign", Exactly(1), Odd),
    entry(Function::Min, "Min", AtLeast(1), Neither),
    entry(Function::Max, "Max", AtLeast(1), Neither),
    entry(Function::Power, "Power", Exactly(2), Neither),
    entry(Function::Piecewise, "Piecewise", Pairs, Neither),
];

impl Function {
    /// All functions, in the order of the table.
    pub fn all() -> impl Iterator<Item = Self> {
        TABLE.iter().map(|entry| entry.function)
    }

    fn entry(self) -> &'static Entry {
        &TABLE[self as usize]
    }

    /// The name that prints and parses.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.entry().name
    }

    /// The function of this name.
    #[must_use]
    pub fn by_name(name: &str) -> Option<Self> {
        TABLE.iter().find(|entry| entry.name == name).map(|entry| entry.function)
    }

    fn check_arity(self, found: usize) -> Result<(), Error> {
        let (fits, expected) = match self.entry().arity {
            Exactly(1) => (found == 1, "1 argument"),
            Exactly(_) => (found == 2, "2 arguments"),
            AtLeast(n) => (found >= n, "at least 1 argument"),
            Pairs => (found % 2 == 1, "pairs of value and condition and a last value for otherwise"),
        };
        if fits { Ok(()) } else { Err(Error::Arity { function: self.name(), expected, found }) }
    }

    /// The value at doubles.
    #[must_use]
    pub fn evaluate(self, args: &[f64]) -> f64 {
        let x = args[0];
        match self {
            Self::Sin => x.sin(),
            Self::Cos => x.cos(),
            Self::Tan => x.tan(),
            Self::Asin => x.asin(),
            Self::Acos => x.acos(),
            Self::Atan => x.atan(),
            Self::Atan2 => x.atan2(args[1]),
            Self::Sinh => x.sinh(),
            Self::Cosh => x.cosh(),
            Self::Tanh => x.tanh(),
            Self::Exp => x.exp(),
            Self::Log => x.ln(),
            Self::Abs => x.abs(),
            Self::Sign if x == 0.0 => 0.0,
            Self::Sign => x.signum(),
            Self::Min => args
                .iter()
                .copied()
                .reduce(|a, b| if a.is_nan() || b.is_nan() { f64::NAN } else { a.min(b) })
                .unwrap_or(x),
            Self::Max => args
                .iter()
                .copied()
                .reduce(|a, b| if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) })
                .unwrap_or(x),
            Self::Power => x.powf(args[1]),
            Self::Piecewise => {
                let chosen = args.chunks_exact(2).find(|pair| pair[1] > 0.0).map(|pair| pair[0]);
                chosen.unwrap_or(args[args.len() - 1])
            }
        }
    }
}

impl Graph {
    /// A function of the table applied to arguments.
    ///
    /// # Errors
    /// When the number of arguments is wrong, or the value is not defined there.
    pub fn apply(&mut self, function: Function, args: &[Id]) -> Result<Id, Error> {
        function.check_arity(args.len())?;
        let args: Vec<Id> = args.iter().map(|&id| self.adopt(id)).collect();
        if let Some(exact) = self.exact_value(function, &args)? {
            return Ok(exact);
        }
        if let Some(result) = self.by_parity(function, &args)? {
            return Ok(result);
        }
        let value = self.function_value(function, &args)?;
        let flags = args.iter().map(|&id| self.flags(id)).reduce(Flags::join).unwrap_or_default();
        let words: Vec<u32> = args.iter().map(|id| id.0).collect();
        Ok(self.finish(Kind::Function(function), flags, &words, value))
    }

    /// f(-x) = -f(x) or f(x): arguments have a positive leading sign.
    fn by_parity(&mut self, function: Function, args: &[Id]) -> Result<Option<Id>, Error> {
        let parity = function.entry().parity;
        let View::Scale(factor, child) = self.view(args[0]) else { return Ok(None) };
        if parity == Neither || !self.get_number(factor).is_negative() {
            return Ok(None);
        }
        let factor = self.get_number(factor).neg();
        let factor = self.number_id(&factor);
        let argument = self.scale(factor, child);
        let result = self.apply(function, &[argument])?;
        Ok(Some(if parity == Odd { self.scale(NumberId::MINUS_ONE, result) } else { result }))
    }

    /// Rules that replace the function by something simpler.
    fn exact_value(&mut self, function: Function, args: &[Id]) -> Result<Option<Id>, Error> {
        let first = args[0];
        if let Some(number) = self.as_number(first).cloned() {
            if let Some(result) = self.at_number(function, &number, args)? {
                return Ok(Some(result));
            }
        }
        let inner = match self.view(first) {
            View::Function(inner, inner_args) => Some((inner, inner_args.get(0))),
            _ => None,
        };
        Ok(match (function, inner) {
            (Function::Log, Some((Function::Exp, x)))
            | (Function::Exp, Some((Function::Log, x)))
            | (Function::Sin, Some((Function::Asin, x)))
            | (Function::Cos, Some((Function::Acos, x)))
            | (Function::Tan, Some((Function::Atan, x))) => Some(x),
            (Function::Abs, Some((Function::Abs, _))) => Some(first),
            (Function::Abs, _) if self.is_positive(first) => Some(first),
            (Function::Abs, _) => match self.view(first) {
                View::Scale(factor, child) => {
                    let factor = self.get_number(factor).abs();
                    if factor.is_one() {
                        None
                    } else {
                        let factor = self.number_id(&factor);
                        let modulus = self.apply(Function::Abs, &[child])?;
                        Some(self.scale(factor, modulus))
                    }
                }
                _ => None,
            },
            (Function::Sign, _) if self.is_positive(first) => Some(Id::ONE),
            (Function::Sign, _) => match self.view(first) {
                View::Scale(factor, child) if !self.get_number(factor).is_negative() => {
                    Some(self.apply(Function::Sign, &[child])?)
                }
                _ => None,
            },
            (Function::Sin | Function::Cos | Function::Tan, _) => self.quarter_turns(function, first)?,
            (Function::Min | Function::Max, _) => self.extremum(function, args)?,
            (Function::Power, _) => self.simple_power(first, args[1])?,
            (Function::Piecewise, _) => self.decided_piecewise(args)?,
            _ => None,
        })
    }

    fn at_number(&mut self, function: Function, number: &Number, args: &[Id]) -> Result<Option<Id>, Error> {
        let domain = || Error::Domain { function: function.name(), argument: number.to_string() };
        let zero = number.is_zero();
        let one = Number::integer(1);
        Ok(match function {
            Function::Sin
            | Function::Tan
            | Function::Asin
            | Function::Atan
            | Function::Sinh
            | Function::Tanh
                if zero =>
            {
                Some(Id::ZERO)
            }
            Function::Cos | Function::Cosh | Function::Exp if zero => Some(Id::ONE),
            Function::Log if zero || number.is_negative() => return Err(domain()),
            Function::Log if number.is_one() => Some(Id::ZERO),
            Function::Asin | Function::Acos if number.abs().compare(&one).is_gt() => return Err(domain()),
            Function::Asin | Function::Acos | Function::Atan => self.inverse_at(function, number),
            Function::Abs => Some(self.number(&number.abs())),
            Function::Sign => {
                Some(if zero { Id::ZERO } else { self.integer(if number.is_negative() { -1 } else { 1 }) })
            }
            Function::Atan2 => match self.as_number(args[1]).cloned() {
                Some(x) => self.atan2_at(number, &x)?,
                None => None,
            },
            _ => None,
        })
    }

    /// asin, acos, atan at 0, +-1/2, +-1, as multiples of pi.
    fn inverse_at(&mut self, function: Function, number: &Number) -> Option<Id> {
        let twice = number.mul(&Number::integer(2)).to_i64()?;
        let multiple = match (function, twice) {
            (Function::Asin, -2..=2) => {
                Number::rational([-3, -1, 0, 1, 3][usize::try_from(twice + 2).ok()?], 6)
            }
            (Function::Acos, -2..=2) => {
                Number::rational([6, 4, 3, 2, 0][usize::try_from(twice + 2).ok()?], 6)
            }
            (Function::Atan, -2 | 0 | 2) => Number::rational(twice, 8),
            _ => return None,
        };
        Some(self.pi_times(&multiple))
    }

    fn pi_times(&mut self, multiple: &Number) -> Id {
        let factor = self.number_id(multiple);
        let pi = self.pi();
        self.scale(factor, pi)
    }

    fn atan2_at(&mut self, y: &Number, x: &Number) -> Result<Option<Id>, Error> {
        if y.is_zero() && x.is_zero() {
            return Err(Error::Domain { function: "atan2", argument: "(0, 0)".into() });
        }
        let sign = |n: &Number| {
            if n.is_zero() {
                0
            } else if n.is_negative() {
                -1
            } else {
                1
            }
        };
        let eighths = match (sign(y), sign(x)) {
            (0, 1) => 0,
            (0, _) => 8,
            (s, 0) => 4 * s,
            (s, r) if y.abs().same_value(&x.abs()) => s * (4 - 2 * r),
            _ => return Ok(None),
        };
        Ok(Some(self.pi_times(&Number::rational(eighths, 8))))
    }

    /// sin, cos, tan of u + k pi/2, and of the multiples of pi that have a short exact value.
    fn quarter_turns(&mut self, function: Function, argument: Id) -> Result<Option<Id>, Error> {
        let Some((multiple, rest)) = self.split_pi(argument) else { return Ok(None) };
        let quarters = multiple.mul(&Number::integer(2));
        let whole = quarters.floor();
        let rest = match rest {
            Some(rest) if quarters.is_integer() => rest,
            Some(_) => return Ok(None),
            None => return self.at_multiple_of_pi(function, &multiple),
        };
        let quadrant =
            whole.sub(&Number::integer(4).mul(&whole.mul(&Number::rational(1, 4)).floor())).to_i64();
        let turned = |graph: &mut Self, f: Function, negative: bool| -> Result<Option<Id>, Error> {
            let value = graph.apply(f, &[rest])?;
            Ok(Some(if negative { graph.scale(NumberId::MINUS_ONE, value) } else { value }))
        };
        match (function, quadrant.unwrap_or(0)) {
            (Function::Sin, 1) => turned(self, Function::Cos, false),
            (Function::Sin, 3) => turned(self, Function::Cos, true),
            (Function::Cos, 1) => turned(self, Function::Sin, true),
            (Function::Cos, 3) => turned(self, Function::Sin, false),
            (Function::Tan, 1 | 3) => {
                let tangent = self.apply(Function::Tan, &[rest])?;
                let cotangent = self.div(Id::ONE, tangent)?;
                Ok(Some(self.scale(NumberId::MINUS_ONE, cotangent)))
            }
            (Function::Tan, _) | (_, 0) => turned(self, function, false),
            _ => turned(self, function, true),
        }
    }

    /// The multiple of pi in a sum and what is left (`None` when nothing is).
    fn split_pi(&mut self, argument: Id) -> Option<(Number, Option<Id>)> {
        let pi = self.pi();
        match self.view(argument) {
            View::Pi => Some((Number::integer(1), None)),
            View::Scale(factor, child) if child == pi => Some((self.get_number(factor).clone(), None)),
            View::Sum(terms) => {
                let (factor, _) = terms.iter().find(|&(_, node)| node == pi)?;
                let rest: Vec<_> = terms.iter().filter(|&(_, node)| node != pi).collect();
                let multiple = self.get_number(factor).clone();
                Some((multiple, Some(self.sum(&rest))))
            }
            _ => None,
        }
    }

    /// Exact values at multiples of pi/12, in radicals.
    fn at_multiple_of_pi(&mut self, function: Function, multiple: &Number) -> Result<Option<Id>, Error> {
        let Some(twelfths) = multiple.mul(&Number::integer(12)).to_i64() else {
            return self.reduced_multiple(function, multiple);
        };
        let k = twelfths.rem_euclid(24);
        let id = match function {
            Function::Sin => self.sine_of_twelfths(k)?,
            Function::Cos => self.sine_of_twelfths((k + 6) % 24)?,
            _ => {
                let (sin, cos) = (self.sine_of_twelfths(k)?, self.sine_of_twelfths((k + 6) % 24)?);
                if cos == Id::ZERO {
                    let argument = format!("{multiple}*pi");
                    return Err(Error::Domain { function: "tan", argument });
                }
                match k % 12 {
                    1 => self.radical_sum(&[(2, 1), (-1, 3)], 1)?,
                    5 => self.radical_sum(&[(2, 1), (1, 3)], 1)?,
                    7 => self.radical_sum(&[(-2, 1), (-1, 3)], 1)?,
                    11 => self.radical_sum(&[(-2, 1), (1, 3)], 1)?,
                    _ => self.div(sin, cos)?,
                }
            }
        };
        Ok(Some(id))
    }

    fn sine_of_twelfths(&mut self, k: i64) -> Result<Id, Error> {
        if k >= 12 {
            let sine = self.sine_of_twelfths(k - 12)?;
            return Ok(self.scale(NumberId::MINUS_ONE, sine));
        }
        match k.min(12 - k) {
            0 => Ok(Id::ZERO),
            1 => self.radical_sum(&[(1, 6), (-1, 2)], 4),
            2 => self.radical_sum(&[(1, 1)], 2),
            3 => self.radical_sum(&[(1, 2)], 2),
            4 => self.radical_sum(&[(1, 3)], 2),
            5 => self.radical_sum(&[(1, 6), (1, 2)], 4),
            _ => Ok(Id::ONE),
        }
    }

    /// (c1 sqrt(r1) + c2 sqrt(r2) + ...) / divisor
    fn radical_sum(&mut self, terms: &[(i64, i64)], divisor: i64) -> Result<Id, Error> {
        let mut sum = Vec::new();
        for &(coefficient, radicand) in terms {
            let radicand = self.integer(radicand);
            let root = self.sqrt(radicand)?;
            sum.push((self.number_id(&Number::rational(coefficient, divisor)), root));
        }
        Ok(self.sum(&sum))
    }

    /// sin, cos, tan of a multiple of pi brought into the first quadrant.
    fn reduced_multiple(&mut self, function: Function, multiple: &Number) -> Result<Option<Id>, Error> {
        let half = Number::rational(1, 2);
        if !multiple.is_negative() && !multiple.compare(&half).is_gt() {
            return Ok(None);
        }
        let turn = multiple.sub(&multiple.mul(&half).floor().mul(&Number::integer(2)));
        let (turn, below) = if turn.compare(&Number::integer(1)).is_gt() {
            (Number::integer(2).sub(&turn), true)
        } else {
            (turn, false)
        };
        let (turn, left) =
            if turn.compare(&half).is_gt() { (Number::integer(1).sub(&turn), true) } else { (turn, false) };
        let argument = self.pi_times(&turn);
        let value = self.apply(function, &[argument])?;
        let negative = match function {
            Function::Sin => below,
            Function::Cos => left,
            _ => below != left,
        };
        Ok(Some(if negative { self.scale(NumberId::MINUS_ONE, value) } else { value }))
    }

    /// Min and Max: one of each value, numbers folded into one.
    fn extremum(&mut self, function: Function, args: &[Id]) -> Result<Option<Id>, Error> {
        let mut kept: Vec<Id> = Vec::new();
        let mut bound: Option<Number> = None;
        for &arg in args {
            if let Some(number) = self.as_number(arg) {
                let replaces =
                    bound.as_ref().is_none_or(|b| (function == Function::Min) == number.compare(b).is_lt());
                if replaces {
                    bound = Some(number.clone());
                }
            } else if !kept.iter().any(|&known| self.equal(known, arg)) {
                kept.push(arg);
            }
        }
        if let Some(bound) = bound {
            kept.push(self.number(&bound));
        }
        kept.sort_by_key(|&id| self.value(id));
        Ok(match kept[..] {
            [single] => Some(single),
            _ if kept == args => None,
            _ => Some(self.apply(function, &kept)?),
        })
    }

    fn simple_power(&mut self, base: Id, exponent: Id) -> Result<Option<Id>, Error> {
        if base == Id::ONE {
            return Ok(Some(Id::ONE));
        }
        if let Some(number) = self.as_number(exponent).cloned() {
            return self.pow_number(base, &number).map(Some);
        }
        if let View::Function(Function::Exp, args) = self.view(base) {
            let inner = args.get(0);
            let argument = self.mul(inner, exponent)?;
            return self.apply(Function::Exp, &[argument]).map(Some);
        }
        Ok(None)
    }

    /// Drop the branches whose condition is a number; the first positive one decides.
    fn decided_piecewise(&mut self, args: &[Id]) -> Result<Option<Id>, Error> {
        let mut kept: Vec<Id> = Vec::new();
        let mut otherwise = args[args.len() - 1];
        for pair in args[..args.len() - 1].chunks_exact(2) {
            match self.as_number(pair[1]) {
                Some(number) if number.is_zero() || number.is_negative() => {}
                Some(_) => {
                    otherwise = pair[0];
                    break;
                }
                None => kept.extend(pair),
            }
        }
        while kept.len() >= 2 && self.equal(kept[kept.len() - 2], otherwise) {
            kept.truncate(kept.len() - 2);
        }
        kept.push(otherwise);
        Ok(match kept[..] {
            [single] => Some(single),
            _ if kept == args => None,
            _ => Some(self.apply(Function::Piecewise, &kept)?),
        })
    }

    /// The value at the random point: by the group laws where there are any, drawn for opaque functions.
    fn function_value(&mut self, function: Function, args: &[Id]) -> Result<Element, Error> {
        let first = args[0];
        let half = || Element::from_number(&Number::rational(1, 2));
        Ok(match function {
            Function::Sin => self.circle(first).sin,
            Function::Cos => self.circle(first).cos,
            Function::Tan => {
                let point = self.circle(first);
                point.sin.mul(point.cos.inverse())
            }
            Function::Exp => self.exponential(first),
            Function::Sinh | Function::Cosh | Function::Tanh => {
                let exponential = self.exponential(first);
                let inverse = exponential.inverse();
                let (sinh, cosh) = (exponential.sub(inverse), exponential.add(inverse));
                match function {
                    Function::Sinh => sinh.mul(half()),
                    Function::Cosh => cosh.mul(half()),
                    _ => sinh.mul(cosh.inverse()),
                }
            }
            Function::Power => self.general_power(first, args[1]),
            _ => self.opaque_value(function, args),
        })
    }

    /// A value drawn for the function and its arguments' values, with the function's parity.
    fn opaque_value(&self, function: Function, args: &[Id]) -> Element {
        if function == Function::Abs {
            // |u| is the root of u^2, whatever form that has.
            let square = self.value(args[0]).powi(2);
            let key = Key::new("root").element(square);
            return Element::draw_exponential(&key).pow_rational(&Number::rational(1, 2));
        }
        let parity = function.entry().parity;
        let key = Key::new("function").text(function.name());
        if parity == Neither {
            return Element::draw(&args.iter().fold(key, |key, &id| key.element(self.value(id))));
        }
        let (argument, negated) = self.value(args[0]).unsigned();
        let value = Element::draw(&key.element(argument));
        if negated && parity == Odd { value.neg() } else { value }
    }
}
