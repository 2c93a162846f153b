//! Exact values: rules that replace a function by something simpler.

use crate::error::Error;
use crate::graph::{Flags, Function, Graph, Id, NumberId, View};
use crate::value::Number;

use super::collector::Collector;

/// Larger powers stay exponentials of logarithms.
const LARGEST_POWER: i64 = 100;

/// Longer products stay inside their modulus unchanged.
const LONGEST_MODULUS: usize = 48;

/// The most parts of an angle that are searched for pi.
const PI_SEARCH: usize = 64;

/// The most parts of an angle that are searched for numbers.
const NUMBER_SEARCH: usize = 4096;

impl Graph {
    /// Rules that replace the function by something simpler.
    pub(super) fn exact_value(&mut self, function: Function, args: &[Id]) -> Result<Option<Id>, Error> {
        let first = args[0];
        if let Some(number) = self.as_number(first).cloned()
            && let Some(result) = self.at_number(function, &number, args)?
        {
            return Ok(Some(result));
        }
        let inner = match self.view(first) {
            View::Function(inner, inner_args) => Some((inner, inner_args.get(0))),
            _ => None,
        };
        Ok(match (function, inner) {
            (Function::Log, Some((Function::Exp, x))) if self.is_real(x) && !self.may_be_negative(x) => {
                Some(x)
            }
            (Function::Exp, Some((Function::Log, x)))
            | (Function::Sin, Some((Function::Asin, x)))
            | (Function::Cos, Some((Function::Acos, x)))
            | (Function::Tan, Some((Function::Atan, x))) => Some(x),
            (Function::Abs, Some((Function::Abs, _))) => Some(first),
            (Function::Abs, _) if self.is_positive(first) => Some(first),
            (Function::Abs, _) if self.is_real(first) => match self.view(first) {
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
                View::Product(_) => self.modulus_of_product(first)?,
                _ => None,
            },
            (Function::Sign, _) if self.is_positive(first) => Some(Id::ONE),
            (Function::Sign, _) if self.is_real(first) => match self.view(first) {
                View::Scale(factor, child) if !self.get_number(factor).is_negative() => {
                    Some(self.apply(Function::Sign, &[child])?)
                }
                _ => None,
            },
            (Function::Sin | Function::Cos | Function::Tan, _) => self.quarter_turns(function, first)?,
            (Function::Exp, _) => self.powers_of_logarithms(first)?,
            (Function::Min | Function::Max, _) => self.extremum(function, args)?,
            (Function::Atan2, _) => self.eighth_of_turn(first, args[1])?,
            (Function::Power, _) => self.simple_power(first, args[1])?,
            (Function::Piecewise, _) => self.decided_piecewise(args)?,
            _ => None,
        })
    }

    /// exp(u + 2*log(x)) = x**2*exp(u)
    fn powers_of_logarithms(&mut self, exponent: Id) -> Result<Option<Id>, Error> {
        let terms: Vec<(NumberId, Id)> = match self.view(exponent) {
            View::Scale(factor, child) => vec![(factor, child)],
            View::Sum(terms) => terms.iter().collect(),
            _ => return Ok(None),
        };
        let (mut powers, mut rest) = (Vec::new(), Vec::new());
        for (factor, node) in terms {
            match self.view(node) {
                View::Function(Function::Log, args) if self.is_real(node) && self.is_short_power(factor) => {
                    powers.push((args.get(0), factor));
                }
                _ => rest.push((factor, node)),
            }
        }
        if powers.is_empty() {
            return Ok(None);
        }
        let rest = self.sum(&rest);
        powers.push((self.apply(Function::Exp, &[rest])?, NumberId::ONE));
        self.product(&powers).map(Some)
    }

    fn is_short_power(&self, exponent: NumberId) -> bool {
        let largest = Number::integer(LARGEST_POWER);
        self.get_number(exponent).abs().compare(&largest).is_le()
    }

    /// |a**2 b| = a**2 |b| for a real a: even powers leave a modulus. And |sqrt(a) b| = sqrt(|a|) |b|, where a may be negative.
    fn modulus_of_product(&mut self, product: Id) -> Result<Option<Id>, Error> {
        let one = Number::integer(1);
        let Some(factors) = self.factors_with_even_powers(product) else { return Ok(None) };
        let (mut outside, mut inside) = (Vec::new(), Vec::new());
        for (base, exponent) in factors {
            let integral = exponent.is_integer() && self.has_real_values(base);
            if self.is_root_outside(base, &exponent) {
                outside.push((self.apply(Function::Abs, &[base])?, self.number_id(&exponent)));
                continue;
            }
            let even = if exponent.is_even() { exponent.clone() } else { exponent.sub(&one) };
            if integral {
                outside.push((base, self.number_id(&even)));
            }
            if !integral || !exponent.is_even() {
                let left = if integral { one.clone() } else { exponent };
                inside.push((base, self.number_id(&left)));
            }
        }
        let inside = self.product(&inside)?;
        // A sign is its own reciprocal. And what is left may be known in a form that has such powers again.
        let left = match self.view(inside) {
            View::Scale(_, child) => child,
            _ => inside,
        };
        if self.same(inside, product) || self.factors_with_even_powers(left).is_some() {
            return Ok(None);
        }
        outside.push((self.apply(Function::Abs, &[inside])?, NumberId::ONE));
        self.product(&outside).map(Some)
    }

    /// The factors of a short product with powers, of which even ones are nowhere negative.
    fn factors_with_even_powers(&self, product: Id) -> Option<Vec<(Id, Number)>> {
        let View::Product(_) = self.view(product) else { return None };
        let opened = self.opened(&[(product, Number::integer(1))]);
        if opened.len() > LONGEST_MODULUS {
            return None;
        }
        let mut collected = Collector::new(Vec::new());
        for (base, exponent) in opened {
            collected.push(self, base, &exponent);
        }
        let factors = collected.factors;
        let leaves = |(base, e): &(Id, Number)| {
            !e.is_one() && e.is_integer() && self.has_real_values(*base) || self.is_root_outside(*base, e)
        };
        factors.iter().any(leaves).then_some(factors)
    }

    /// Whether a power is a root of what may be negative, which leaves a modulus as a root of the modulus.
    fn is_root_outside(&self, base: Id, exponent: &Number) -> bool {
        !exponent.is_integer() && !self.is_nowhere_negative(base)
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

    /// atan2(y, x) where y = 0, x = 0, or |y| = |x|, and the signs are known.
    fn eighth_of_turn(&mut self, y: Id, x: Id) -> Result<Option<Id>, Error> {
        let is_diagonal = self.same_up_to_sign(y, x);
        if !is_diagonal && y != Id::ZERO && x != Id::ZERO {
            return Ok(None);
        }
        let (Some(sine), Some(cosine)) = (self.known_sign(y)?, self.known_sign(x)?) else { return Ok(None) };
        self.atan2_at(&sine, &cosine)
    }

    /// The sign of a real node, if it is the same everywhere. Complex symbols of its form may cancel.
    fn known_sign(&mut self, id: Id) -> Result<Option<Number>, Error> {
        let id = if self.is_real(id) { id } else { self.representative(id) };
        if !self.is_real(id) {
            return Ok(None);
        }
        let sign = self.apply(Function::Sign, &[id])?;
        Ok(self.as_number(sign).cloned())
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
        let quadrant = quadrant.expect("a remainder of the division by four is a small integer");
        let turned = |graph: &mut Self, f: Function, negative: bool| -> Result<Option<Id>, Error> {
            let value = graph.apply(f, &[rest])?;
            Ok(Some(if negative { graph.scale(NumberId::MINUS_ONE, value) } else { value }))
        };
        match (function, quadrant) {
            (Function::Sin, 1) => turned(self, Function::Cos, false),
            (Function::Sin, 3) => turned(self, Function::Cos, true),
            (Function::Cos, 1) => turned(self, Function::Sin, true),
            (Function::Cos, 3) => turned(self, Function::Sin, false),
            (Function::Tan, 1 | 3) if self.is_pole_of_tangent(rest) => Ok(Some(Id::ZERO)),
            (Function::Tan, 1 | 3) => {
                let tangent = self.apply(Function::Tan, &[rest])?;
                let cotangent = self.div(Id::ONE, tangent)?;
                Ok(Some(self.scale(NumberId::MINUS_ONE, cotangent)))
            }
            (Function::Tan, _) | (_, 0) => turned(self, function, false),
            _ => turned(self, function, true),
        }
    }

    /// The multiple of pi in an argument, also inside its sums, and the rest of the argument (`None` if there is none).
    fn split_pi(&mut self, argument: Id) -> Option<(Number, Option<Id>)> {
        if !self.flags(argument).has(Flags::INVERSE) {
            return None; // no pi is below
        }
        let mut visits = PI_SEARCH;
        let (multiple, rest) = self.without_pi(argument, &mut visits)?;
        (!multiple.is_zero()).then_some((multiple, Some(rest).filter(|&rest| rest != Id::ZERO)))
    }

    /// The multiple of pi among the terms of a node, and the node without it; `None` if there is no multiple.
    fn without_pi(&mut self, id: Id, visits: &mut usize) -> Option<(Number, Id)> {
        if let View::Pi = self.view(id) {
            return Some((Number::integer(1), Id::ZERO));
        }
        *visits = visits.checked_sub(1)?;
        match self.view(id) {
            View::Scale(factor, child) => {
                let (multiple, rest) = self.without_pi(child, visits)?;
                let multiple = multiple.mul(self.get_number(factor));
                Some((multiple, self.scale(factor, rest)))
            }
            View::Sum(terms) => {
                let mut terms: Vec<_> = terms.iter().collect();
                let mut total = None;
                for (factor, node) in &mut terms {
                    if let Some((multiple, rest)) = self.without_pi(*node, visits) {
                        let multiple = multiple.mul(self.get_number(*factor));
                        total = Some(total.map_or(multiple.clone(), |sum: Number| sum.add(&multiple)));
                        *node = rest;
                    }
                }
                let total = total?;
                Some((total, self.sum(&terms)))
            }
            _ => None,
        }
    }

    /// The rational number in the sums of an angle, in radians, without the multiple of pi.
    #[must_use]
    pub fn radians(&self, angle: Id) -> Number {
        let mut total = Number::integer(0);
        let mut waiting = vec![(Number::integer(1), angle)];
        for _ in 0..NUMBER_SEARCH {
            let Some((factor, id)) = waiting.pop() else { break };
            let times = |number: NumberId| self.get_number(number).mul(&factor);
            match self.view(id) {
                View::Number(number) => total = total.add(&times(number)),
                View::Scale(number, child) => waiting.push((times(number), child)),
                View::Sum(terms) => waiting.extend(terms.iter().map(|(number, node)| (times(number), node))),
                _ => {}
            }
        }
        total
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

    /// Min and Max: drop arguments of equal value, and fold numbers into one.
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
        kept.sort_by(|&a, &b| self.compare_values(a, b).then_with(|| self.value(a).cmp(&self.value(b))));
        Ok(match kept[..] {
            [single] => Some(single),
            _ if kept == args => None,
            _ => Some(self.apply(function, &kept)?),
        })
    }

    fn simple_power(&mut self, base: Id, exponent: Id) -> Result<Option<Id>, Error> {
        if self.as_number(base).is_some_and(Number::is_one) {
            return Ok(Some(base));
        }
        if let Some(number) = self.as_number(exponent).cloned() {
            return self.pow_number(base, &number).map(Some);
        }
        if let View::Function(Function::Exp, args) = self.view(base)
            && self.is_real(base)
            && !self.may_be_negative(args.get(0))
        {
            let inner = args.get(0);
            let argument = self.mul(inner, exponent)?;
            return self.apply(Function::Exp, &[argument]).map(Some);
        }
        Ok(None)
    }
}
