//! Powers: the numbers, inner powers and positive factors of a base that leave it.
//!
//! A power is collected as factors of the product that it is part of. `(2*x*y)**3` has the coefficient 8, and
//! `sqrt(a*x)` is `sqrt(a)*sqrt(x)` for a positive `a`.

use crate::error::Error;
use crate::graph::{Flags, Function, Graph, Id, Kind, NumberId, View};
use crate::value::Number;

use super::collector::Collector;
use super::root::collect_number;

impl Graph {
    /// Add base ** exponent to the collector, with numbers taken out and inner powers and multiples resolved.
    pub(super) fn collect_power(
        &mut self,
        out: &mut Collector,
        base: Id,
        exponent: &Number,
    ) -> Result<(), Error> {
        if exponent.is_zero() {
            return Ok(());
        }
        if base == Id::ZERO {
            if exponent.is_negative() {
                return Err(Error::DivisionByZero("0".into()));
            }
            out.coefficient = Number::integer(0);
            return Ok(());
        }
        match self.view(base) {
            View::Number(number) => {
                let number = self.get_number(number).clone();
                collect_number(out, &number, exponent)
            }
            View::Scale(number, child) => {
                let number = self.get_number(number).clone();
                if exponent.is_integer() {
                    collect_number(out, &number, exponent)?;
                    return self.collect_power(out, child, exponent);
                }
                if !self.is_real(child) {
                    // The branch of the root of a complex number belongs to that number.
                    out.push(self, base, exponent);
                    return Ok(());
                }
                collect_number(out, &number.abs(), exponent)?;
                if number.is_negative() {
                    let opposite = self.scale(NumberId::MINUS_ONE, child);
                    out.push(self, opposite, exponent);
                    return Ok(());
                }
                self.collect_power(out, child, exponent)
            }
            View::Product(factors) => {
                let inner: Vec<(Id, Number)> =
                    factors.iter().map(|(id, e)| (id, self.get_number(e).clone())).collect();
                self.collect_product_power(out, base, &inner, exponent)
            }
            View::Sum(_) if !exponent.is_integer() => self.collect_root_of_sum(out, base, exponent),
            View::Function(Function::Exp, args)
                if !exponent.is_integer() && self.is_real(base) && !self.may_be_negative(args.get(0)) =>
            {
                let argument = args.get(0);
                let factor = self.number_id(exponent);
                let argument = self.scale(factor, argument);
                let power = self.apply(Function::Exp, &[argument])?;
                out.push(self, power, &Number::integer(1));
                Ok(())
            }
            View::Function(Function::Abs, args)
                if exponent.is_even() && self.has_real_values(args.get(0)) =>
            {
                let argument = args.get(0);
                self.collect_power(out, argument, exponent)
            }
            _ => {
                out.push(self, base, exponent);
                Ok(())
            }
        }
    }

    /// (product of powers) ** exponent: the factors that allow it get the exponent, and the others stay one base.
    fn collect_product_power(
        &mut self,
        out: &mut Collector,
        base: Id,
        inner: &[(Id, Number)],
        exponent: &Number,
    ) -> Result<(), Error> {
        if exponent.is_integer() {
            let distribute = inner.len() == 1 || (self.flags(base).has(Flags::ROOT) && !exponent.is_one());
            if !distribute {
                out.push(self, base, exponent);
                return Ok(());
            }
            for (node, e) in inner {
                self.collect_power(out, *node, &e.mul(exponent))?;
            }
            return Ok(());
        }
        if !self.is_real(base) {
            out.push(self, base, exponent);
            return Ok(());
        }
        let inner = &self.opened(inner);
        if let [(node, e)] = &inner[..]
            && e.is_even()
            && !self.is_positive(*node)
        {
            // (u**2k)**r = |u|**(2kr) for real u.
            let modulus = self.apply(Function::Abs, &[*node])?;
            return self.collect_power(out, modulus, &e.mul(exponent));
        }
        let (positive, rest): (Vec<_>, Vec<_>) =
            inner.iter().cloned().partition(|(node, _)| self.is_positive(*node));
        if positive.is_empty() {
            out.push(self, base, exponent);
            return Ok(());
        }
        let rest: Vec<_> = rest.into_iter().map(|(node, e)| (node, self.number_id(&e))).collect();
        let rest = self.product(&rest)?;
        if let Some(number) = self.as_number(rest).filter(|number| number.is_negative()).cloned() {
            return self.collect_negative_multiple(out, &number, &positive, exponent);
        }
        for (node, e) in &positive {
            self.collect_power(out, *node, &e.mul(exponent))?;
        }
        self.collect_rest(out, rest, exponent)
    }

    /// Add the root of a negative number times positive factors. The sign stays with the factors, as in the root of a
    /// multiple. The number is the value that a derivation knows of the other factors.
    fn collect_negative_multiple(
        &mut self,
        out: &mut Collector,
        number: &Number,
        positive: &[(Id, Number)],
        exponent: &Number,
    ) -> Result<(), Error> {
        let factors: Vec<_> = positive.iter().map(|(node, e)| (*node, self.number_id(e))).collect();
        let product = self.product(&factors)?;
        collect_number(out, &number.abs(), exponent)?;
        let opposite = self.scale(NumberId::MINUS_ONE, product);
        out.push(self, opposite, exponent);
        Ok(())
    }

    /// Add the root of what its positive factors have left. A derivation may know it as a product with positive factors
    /// again, and these stay.
    fn collect_rest(&mut self, out: &mut Collector, rest: Id, exponent: &Number) -> Result<(), Error> {
        let (factor, node) = self.split_multiple(NumberId::ONE, rest);
        if self.kind(node) != Kind::Product {
            return self.collect_power(out, rest, exponent);
        }
        let factor = self.get_number(factor).clone();
        collect_number(out, &factor.abs(), exponent)?;
        let node = if factor.is_negative() { self.scale(NumberId::MINUS_ONE, node) } else { node };
        out.push(self, node, exponent);
        Ok(())
    }
}
