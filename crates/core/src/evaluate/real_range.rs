//! Which values nodes have for real variables: any, real ones, or none that are negative, as far as forms show, and for
//! radicands also as far as values show.
//!
//! A finite field does not tell sqrt(x^2 + y^2), which is real, from sqrt(x), which is not where x is negative: in a lane
//! both may lie outside GF(p). The modulus of the one is the root itself, and that of the other one is sqrt(|x|). So what a
//! modulus is where its argument lies outside GF(p) follows from what is proved here about the representative.

use crate::graph::{Assumption, Factors, Flags, Function, Graph, Id, RealRange, View};
use crate::value::{FieldId, Number, Quadratic};

use super::rational_power::power_of_content;

use RealRange::{Any, NotNegative, Real};

impl Graph {
    /// Whether a node is known to be real for real variables.
    pub(crate) fn has_real_values(&self, id: Id) -> bool {
        let flags = self.flags(id);
        !flags.has(Flags::COMPLEX) && (!flags.has(Flags::BRANCH) || self.real_range(id) != Any)
    }

    /// Whether a node is known to be real and nowhere negative.
    pub(crate) fn is_nowhere_negative(&self, id: Id) -> bool {
        let id = self.representative(id);
        self.range_by_value(id, self.real_range(id)) == NotNegative
    }

    /// The range of a radicand or of the base of a power from that which its form shows.
    fn range_by_value(&self, id: Id, range: RealRange) -> RealRange {
        if range == Real && self.is_seen_nonnegative(id) { NotNegative } else { range }
    }

    /// Whether a real node is seen to be nowhere negative by value, or each of its factors by form or by value.
    fn is_seen_nonnegative(&self, id: Id) -> bool {
        let is_nonnegative = |(base, exponent)| {
            let exponent: &Number = self.get_number(exponent);
            exponent.is_even() || self.real_range(base) == NotNegative || self.is_semidefinite(base)
        };
        self.is_semidefinite(id)
            || matches!(self.view(id), View::Product(factors) if factors.iter().all(is_nonnegative))
    }

    fn real_range(&self, id: Id) -> RealRange {
        let id = self.representative(id);
        if let Some(known) = self.lanes.borrow().real_range(id) {
            return known;
        }
        let is_unknown = |id: Id| self.lanes.borrow().real_range(id).is_none();
        for node in self.parts_first(&[id], is_unknown) {
            let range = self.range_from_parts(node);
            self.lanes.borrow_mut().insert_real_range(node, range);
        }
        self.lanes.borrow().real_range(id).unwrap_or(Any)
    }

    fn range_from_parts(&self, id: Id) -> RealRange {
        let of = |id: Id| self.lanes.borrow().real_range(id).unwrap_or(Any);
        let signed = |range: RealRange, is_negative: bool| if is_negative { range.min(Real) } else { range };
        match self.view(id) {
            View::Pi | View::Symbol(_, Assumption::Positive) => NotNegative,
            View::Number(number) => signed(NotNegative, self.get_number(number).is_negative()),
            View::Scale(factor, child) => signed(of(child), self.get_number(factor).is_negative()),
            View::Sum(terms) => terms
                .iter()
                .map(|(factor, node)| signed(of(node), self.get_number(factor).is_negative()))
                .min()
                .unwrap_or(Any),
            View::Product(factors) => self.range_of_product(factors, of),
            View::Function(Function::Sin | Function::Cos | Function::Tan, args)
                if self.contains_arc(self.representative(args.get(0))) =>
            {
                Any // cos(asin(x)) is the root of 1 - x^2
            }
            View::Function(function, args) => {
                let mut ranges: Vec<RealRange> = self.represented(args).map(of).collect();
                if matches!(function, Function::Power | Function::Log) {
                    ranges[0] = self.range_by_value(self.representative(args.get(0)), ranges[0]);
                }
                range_of_function(function, &ranges)
            }
            _ if self.flags(id).has(Flags::COMPLEX) => Any,
            _ => self.children(id).into_iter().map(of).min().unwrap_or(Real).min(Real),
        }
    }

    /// Whether an angle contains arc sines or arc cosines, which are real only for arguments in [-1, 1].
    fn contains_arc(&self, angle: Id) -> bool {
        let parts = self.parts_first(&[angle], |id| self.flags(id).has(Flags::INVERSE));
        let is_arc = |id: Id| matches!(self.view(id), View::Function(Function::Asin | Function::Acos, _));
        parts.into_iter().any(is_arc)
    }

    fn range_of_product(&self, factors: Factors<'_>, of: impl Fn(Id) -> RealRange) -> RealRange {
        let range = |(base, exponent)| {
            let exponent: &Number = self.get_number(exponent);
            let is_whole = exponent.is_integer();
            let base = if is_whole { base } else { self.representative(base) };
            match of(base) {
                Real if exponent.is_even() => NotNegative,
                Real if !is_whole && self.range_by_value(base, Real) == Real => Any,
                Real if !is_whole => NotNegative,
                range => range,
            }
        };
        factors.iter().map(range).min().unwrap_or(Any)
    }

    /// |u| in a field. What is real in the lane, or known to be real, is multiplied by its sign.
    pub(super) fn modulus_in(&self, id: Id, field: FieldId) -> Quadratic {
        let (f, value) = (field.field(), self.value_in(id, field));
        if self.has_sign_in(id, field) {
            return f.mul(&self.sign_in(id, field), &value);
        }
        match self.numeric_content(id, f) {
            Some(content) => {
                let scale = power_of_content(&content, &Number::integer(1), f);
                f.mul(&scale, &f.absolute_value(&f.div(&value, &scale)))
            }
            None => f.absolute_value(&value),
        }
    }

    /// Whether the modulus of a node in a field is the node or its opposite.
    pub(super) fn has_sign_in(&self, id: Id, field: FieldId) -> bool {
        self.value_in(id, field.of_signs()).is_real() || self.has_real_values(id)
    }
}

fn range_of_function(function: Function, args: &[RealRange]) -> RealRange {
    let least = args.iter().copied().min().unwrap_or(Any);
    match function {
        Function::Abs => NotNegative,
        Function::Exp | Function::Cosh => {
            if least == Any {
                Any
            } else {
                NotNegative
            }
        }
        Function::Log => {
            if least == NotNegative {
                Real
            } else {
                Any
            }
        }
        Function::Power => {
            if args[0] == NotNegative && least != Any {
                NotNegative
            } else {
                Any
            }
        }
        Function::Max if least == Real && args.contains(&NotNegative) => NotNegative,
        Function::Max | Function::Min => least,
        Function::Piecewise => least.max(range_of_piecewise(args)),
        Function::Sinh | Function::Tanh | Function::Sign | Function::Atan if least == NotNegative => {
            NotNegative
        }
        _ => least.min(Real),
    }
}

/// The range of the branches, if the conditions are real.
fn range_of_piecewise(args: &[RealRange]) -> RealRange {
    let (branches, conditions): (Vec<_>, Vec<_>) =
        args.iter().zip(0..).partition(|&(_, place)| place % 2 == 0 || place + 1 == args.len());
    let least = |parts: Vec<(&RealRange, usize)>| parts.into_iter().map(|(range, _)| *range).min();
    if least(conditions) == Some(Any) { Any } else { least(branches).unwrap_or(Any) }
}
