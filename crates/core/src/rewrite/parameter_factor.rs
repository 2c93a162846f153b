//! Factors of parameters outside of sums: `x y / l**2 + z w / l**2` becomes `(x y + z w) / l**2`.
//!
//! Factors are found through products of products, so that each `u_i v_i` of a scalar product counts, where u and v are
//! vectors with a factor of their own.

use crate::error::Error;
use crate::graph::{Flags, Graph, Id, NumberId, View};
use crate::value::Number;

type Factor = (Id, Number);

impl Graph {
    /// A sum with the factor outside that all its terms have, if it depends on parameters alone. Numbers among the
    /// terms have no such factor: `u / l - 1` keeps its 1.
    ///
    /// # Errors
    /// If a division fails.
    pub fn parameters_outside(&mut self, id: Id) -> Result<Id, Error> {
        self.choose_form(|graph| {
            let (factor, node) = graph.split_multiple(NumberId::ONE, id);
            let View::Sum(terms) = graph.view(node) else { return Ok(id) };
            let (plain, terms): (Vec<_>, Vec<_>) =
                terms.iter().partition(|&(_, node)| graph.is_constant(node));
            let terms: Vec<Id> = terms.into_iter().map(|(c, node)| graph.scale(c, node)).collect();
            let (common, rests) = graph.common_parameters(&terms)?;
            if common == Id::ONE {
                return Ok(id);
            }
            let rests: Vec<_> = rests.into_iter().map(|rest| (NumberId::ONE, rest)).collect();
            let sum = graph.sum(&rests);
            let product = graph.mul(common, sum)?;
            let mut parts = vec![(NumberId::ONE, product)];
            parts.extend(plain);
            let whole = graph.sum(&parts);
            let form = graph.scale(factor, whole);
            Ok(if graph.same(form, id) { form } else { id })
        })
    }

    /// The factor that several expressions have in common, as far as it depends on parameters alone, and each of them
    /// without it. Without such a factor, this is 1. Zeros have every factor.
    ///
    /// # Errors
    /// If a division fails.
    pub fn common_parameters(&mut self, ids: &[Id]) -> Result<(Id, Vec<Id>), Error> {
        let parts: Vec<(Number, Vec<Factor>)> = ids.iter().map(|&id| self.factors_of(id)).collect();
        let mut varying = ids.iter().zip(&parts).filter(|&(&id, _)| id != Id::ZERO).map(|(_, part)| part);
        let Some((size, factors)) = varying.next() else { return Ok((Id::ONE, ids.to_vec())) };
        let (mut size, mut common) = (size.abs(), factors.clone());
        common.retain(|&(base, _)| self.is_parameter(base));
        for (other, factors) in varying {
            common.retain(|factor| factors.contains(factor));
            if !other.abs().same_value(&size) {
                size = Number::integer(1);
            }
        }
        if common.is_empty() {
            return Ok((Id::ONE, ids.to_vec()));
        }
        let factor = self.product_of_factors(&size, &common)?;
        let mut rests = Vec::with_capacity(ids.len());
        for (&id, (number, factors)) in ids.iter().zip(&parts) {
            let rest: Vec<Factor> =
                factors.iter().filter(|factor| !common.contains(factor)).cloned().collect();
            rests.push(match id {
                Id::ZERO => id,
                _ => self.product_of_factors(&number.mul(&size.recip()?), &rest)?,
            });
        }
        Ok((factor, rests))
    }

    /// The number and the powers of which an expression is the product, through products of products.
    fn factors_of(&self, id: Id) -> (Number, Vec<Factor>) {
        let mut number = Number::integer(1);
        let mut factors: Vec<Factor> = Vec::new();
        let mut open = vec![(id, Number::integer(1))];
        while let Some((node, exponent)) = open.pop() {
            match self.view(node) {
                View::Number(value) if exponent.is_one() => number = number.mul(self.get_number(value)),
                View::Scale(value, child) if exponent.is_one() => {
                    number = number.mul(self.get_number(value));
                    open.push((child, exponent));
                }
                View::Product(inner) if exponent.is_integer() => {
                    let inner: Vec<_> = inner.iter().collect();
                    for (base, e) in inner.into_iter().rev() {
                        open.push((base, self.get_number(e).mul(&exponent)));
                    }
                }
                _ => match factors.iter_mut().find(|(base, _)| *base == node) {
                    Some((_, known)) => *known = known.add(&exponent),
                    None => factors.push((node, exponent)),
                },
            }
        }
        factors.retain(|(_, exponent)| !exponent.is_zero());
        (number, factors)
    }

    /// Whether a node depends on parameters and constants alone, and has no signs or roots of its own.
    fn is_parameter(&self, id: Id) -> bool {
        let flags = self.flags(id);
        flags.level() == 0 && !flags.has(Flags::BRANCH)
    }

    fn product_of_factors(&mut self, number: &Number, factors: &[Factor]) -> Result<Id, Error> {
        let mut powers = vec![(self.number(number), NumberId::ONE)];
        for (base, exponent) in factors {
            let exponent = self.number_id(exponent);
            powers.push((*base, exponent));
        }
        self.product(&powers)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::Assumption;

    fn functions<const N: usize>(g: &mut Graph, names: [&str; N]) -> Result<[Id; N], Error> {
        let mut functions = [Id::ZERO; N];
        for (function, name) in functions.iter_mut().zip(names) {
            *function = g.time_function(name, 0)?;
        }
        Ok(functions)
    }

    #[test]
    fn factors_of_parameters_are_found_through_products_of_products() -> Result<(), Error> {
        let g = &mut Graph::new();
        let l = g.symbol("l", Assumption::Real);
        let [x, y, z, w] = functions(g, ["x", "y", "z", "w"])?;
        let quotient = |g: &mut Graph, a: Id, b: Id| -> Result<Id, Error> {
            let (u, v) = (g.div(a, l)?, g.div(b, l)?);
            g.mul(u, v)
        };
        let (one, two) = (quotient(g, x, y)?, quotient(g, z, w)?);
        let terms = g.add(one, two);
        let sum = g.sub(terms, Id::ONE);
        let form = g.parameters_outside(sum)?;
        assert!(g.equal(form, sum));
        assert_eq!((g.cost(&[sum]).total(), g.cost(&[form]).total()), (8, 6)); // (x y + z w) / l**2 - 1
        Ok(())
    }

    #[test]
    fn without_a_common_parameter_nothing_changes() -> Result<(), Error> {
        let g = &mut Graph::new();
        let l = g.symbol("l", Assumption::Real);
        let [x, y] = functions(g, ["x", "y"])?;
        let quotient = g.div(x, l)?;
        let sum = g.add(quotient, y);
        assert_eq!(g.parameters_outside(sum)?, sum);
        assert_eq!(g.common_parameters(&[quotient, y])?, (Id::ONE, vec![quotient, y]));
        Ok(())
    }
}
