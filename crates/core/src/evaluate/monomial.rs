//! Monomials: nodes that are a number times powers of positive factors, also where the form does not show it.
//!
//! The *generators* below a node are positive symbols, exponentials, and powers with symbolic exponents. Their logarithms
//! may depend on each other, as that of exp(x + y) on those of exp(x) and exp(y). Values at several points show how,
//! and which generators form a basis. The power of each of these in the node is read off at a point of integers, where
//! this generator is a large power of two and the others of the basis are 1. Then the product is compared with the node in all lanes.

use num_integer::Integer;
use rustc_hash::FxHashMap;

use crate::graph::{Assumption, Function, Generator, Graph, Id, Ids, Monomial, View};
use crate::value::{Field, FieldId, Number, Quadratic, fingerprint};

use super::integer_point::{Doublings, IntegerPoint};
use super::logarithm::DEPTH;
use super::rational_power::power_of_number;

/// The most generators below a node.
const MOST_GENERATORS: usize = 24;

/// Generators are at least 2 to this power at a point of integers. Powers whose exponents have denominators that divide
/// this, or the denominators of the exponents below a node, are found.
const DOUBLINGS: i64 = 12;

/// The most doublings of a generator.
const MOST_DOUBLINGS: i64 = 5040;

/// The degrees of roots of numbers that are tried, besides the denominators of exponents.
const ROOTS: [i64; 6] = [1, 2, 3, 4, 6, 12];

impl Graph {
    /// The root of a number and the powers of generators whose product has the value of a node, if there are such.
    pub(super) fn monomial(&self, id: Id) -> Option<Monomial> {
        let id = self.representative(id);
        if let Some(known) = self.lanes.borrow().monomial(id) {
            return known.clone();
        }
        let monomial = self.find_monomial(id);
        self.lanes.borrow_mut().insert_monomial(id, monomial.clone());
        monomial
    }

    fn find_monomial(&self, id: Id) -> Option<Monomial> {
        if self.is_complex(id) || self.as_number(id).is_some() {
            return None;
        }
        let generators = self.generators(id)?;
        let denominator = self.denominator_of_exponents(id)?;
        // By how many doublings a generator is larger at its point of integers.
        let unit = denominator.lcm(&DOUBLINGS);
        let powers = self.powers_of_basis(id, &generators, unit, IntegerPoint::PLAIN)?;
        let product = |field: FieldId| self.product_of_powers(&powers, field);
        let content = self.rational_content(id, FieldId::HASH[0].field());
        let degrees = ROOTS.into_iter().chain([denominator]);
        let (root, number) = root_of_number(&content, degrees, |field| {
            field.field().div(&self.value_in(id, field), &product(field))
        })?;
        let whole = |field: FieldId| {
            let f = field.field();
            f.mul(&power_of_number(&number, &root, f), &product(field))
        };
        let in_hash_lanes = FieldId::HASH.into_iter().all(|field| self.value_in(id, field) == whole(field));
        (in_hash_lanes && self.is_everywhere(id, whole)).then_some(Monomial { number, root, powers })
    }

    /// The same where signs are those of a lane, if the node holds signs and no roots.
    pub(super) fn monomial_in(&self, id: Id, lane: FieldId) -> Option<Monomial> {
        let id = self.representative(id);
        if !self.has_signs_alone(id) {
            return None;
        }
        if let Some(known) = self.lanes.borrow().monomial_in(id, lane) {
            return known.clone();
        }
        let monomial = self.find_monomial_in(id, lane);
        self.lanes.borrow_mut().insert_monomial_in(id, lane, monomial.clone());
        monomial
    }

    fn find_monomial_in(&self, id: Id, lane: FieldId) -> Option<Monomial> {
        let generators = self.generators(id).filter(|found| !found.is_empty() && !self.is_complex(id))?;
        let unit = self.denominator_of_exponents(id)?.lcm(&DOUBLINGS);
        let point = IntegerPoint::with_signs_of(lane);
        let number = self.at_integers(id, point).filter(|n| !n.is_zero() && !n.is_negative())?;
        let powers = self.powers_of_basis(id, &generators, unit, point)?;
        let f = lane.field();
        let whole = f.mul(&f.number(&number), &self.product_of_powers(&powers, lane));
        let root = Number::integer(1);
        (self.value_in(id, lane) == whole).then_some(Monomial { number, root, powers })
    }

    /// The powers of the generators of a basis in a node, read off at a point of integers.
    fn powers_of_basis(
        &self,
        id: Id,
        generators: &[Generator],
        unit: i64,
        point: IntegerPoint<'_>,
    ) -> Option<Vec<(Generator, Number)>> {
        let mut powers = Vec::new();
        for (generator, unit, doublings) in self.basis(generators, unit)? {
            let exponent = self.doublings_at_integers(id, &doublings, point)?;
            if exponent != 0 {
                powers.push((generator, Number::rational(exponent, unit)));
            }
        }
        Some(powers)
    }

    fn product_of_powers(&self, powers: &[(Generator, Number)], field: FieldId) -> Quadratic {
        let f = field.field();
        powers.iter().fold(f.one(), |product, (generator, exponent)| {
            f.mul(&product, &f.rational_power(&self.generator_in(generator, field), exponent))
        })
    }

    /// A multiple of the denominators of all exponents below a node, where those of roots inside roots are multiplied.
    fn denominator_of_exponents(&self, id: Id) -> Option<i64> {
        let mut units: FxHashMap<Id, i64> = FxHashMap::default();
        let mut parts = Vec::new();
        for node in self.short_order(&[id])? {
            let unit_of = |id: Id| units.get(&id).copied().unwrap_or(1);
            let mut unit = 1;
            if let View::Product(factors) = self.view(node) {
                for (base, exponent) in factors.iter() {
                    let exponent = self.get_number(exponent);
                    let base = if exponent.is_integer() { base } else { self.representative(base) };
                    unit = unit.lcm(&(unit_of(base) * exponent.to_small()?.1));
                }
            } else {
                parts.clear();
                self.push_parts(node, &mut parts);
                unit = parts.iter().fold(1, |unit, &part| unit.lcm(&unit_of(part)));
            }
            if unit.lcm(&DOUBLINGS) > MOST_DOUBLINGS {
                return None;
            }
            units.insert(node, unit);
        }
        units.get(&id).copied()
    }

    /// The positive factors that the value of a node may hold; `None` if they are many.
    fn generators(&self, id: Id) -> Option<Vec<Generator>> {
        let mut generators = Vec::new();
        let argument = |args: Ids<'_>, place| self.representative(args.get(place));
        for node in self.short_order(&[id])? {
            let generator = match self.view(node) {
                View::Pi | View::Symbol(_, Assumption::Positive) => Generator::Symbol(node),
                View::Function(Function::Acos, _) => Generator::Symbol(Id::PI), // acos x = pi/2 - asin x
                View::Function(Function::Exp | Function::Sinh | Function::Cosh | Function::Tanh, args)
                    if !self.is_complex(node) && !self.may_be_negative(args.get(0)) =>
                {
                    Generator::Exponential(argument(args, 0))
                }
                View::Function(Function::Power, args)
                    if !self.is_complex(node) && self.is_monomial(args.get(0), DEPTH) =>
                {
                    Generator::Power { base: argument(args, 0), exponent: argument(args, 1) }
                }
                _ => continue,
            };
            if !generators.contains(&generator) {
                generators.push(generator);
            }
        }
        (generators.len() <= MOST_GENERATORS).then_some(generators)
    }

    /// A basis of the generators, each with its doublings and those of all generators at the point of integers for it:
    /// where exp(109) is of the basis, exp(6) has 6/109 of its doublings.
    fn basis(&self, generators: &[Generator], unit: i64) -> Option<Vec<(Generator, i64, Doublings)>> {
        let columns = generators.len();
        let exponents = FieldId::HASH[0].of_exponents()?;
        let f = exponents.field();
        let points = u16::try_from(columns).ok()? + 2;
        let mut matrix: Vec<Vec<Quadratic>> = (0..points)
            .map(|point| {
                let field = exponents.at(point);
                let real = |value: &Quadratic| f.real_image(value);
                generators
                    .iter()
                    .map(|generator| real(&self.logarithm_of_generator(generator, field)))
                    .collect()
            })
            .collect();
        let pivots = reduce(&mut matrix, columns, f);
        let doublings = |row: &[Quadratic]| {
            let ratios: Option<Vec<Number>> = row.iter().map(|ratio| f.small_rational(ratio)).collect();
            let ratios = ratios?;
            let denominators = ratios.iter().map(|ratio| Some(ratio.to_small()?.1));
            let scale = denominators.into_iter().try_fold(unit, |scale, d| Some(scale.lcm(&d?)))?;
            if scale > MOST_DOUBLINGS {
                return None;
            }
            let count = |ratio: &Number| ratio.mul(&Number::integer(scale)).to_i64();
            let counts =
                generators.iter().zip(&ratios).map(|(&generator, ratio)| Some((generator, count(ratio)?)));
            Some((scale, counts.collect::<Option<Doublings>>()?))
        };
        let of_pivot = |(pivot, row): (usize, &Vec<Quadratic>)| {
            let (scale, doublings) = doublings(row)?;
            Some((generators[pivot], scale, doublings))
        };
        pivots.into_iter().zip(&matrix).map(of_pivot).collect()
    }

    /// The value of a generator in a field.
    fn generator_in(&self, generator: &Generator, field: FieldId) -> Quadratic {
        match *generator {
            Generator::Symbol(id) => self.value_in(id, field),
            Generator::Exponential(argument) => self.exponential_in(argument, field),
            Generator::Power { base, exponent } => self.general_power_in(base, exponent, field),
        }
    }

    /// The value of the logarithm of a generator in a field.
    pub(super) fn logarithm_of_generator(&self, generator: &Generator, field: FieldId) -> Quadratic {
        match *generator {
            Generator::Symbol(id) => self.atomic_logarithm(id, field),
            Generator::Exponential(argument) => self.value_in(argument, field),
            Generator::Power { base, exponent } => {
                field.field().mul(&self.value_in(exponent, field), &self.logarithm_in(base, field))
            }
        }
    }
}

/// The exponent 1/n and the positive number of a root that has a value in the hash lanes, and this content.
fn root_of_number(
    content: &Number,
    mut degrees: impl Iterator<Item = i64>,
    value: impl Fn(FieldId) -> Quadratic,
) -> Option<(Number, Number)> {
    let [first, second] = FieldId::HASH.map(|field| {
        let f = field.field();
        (f.div(&value(field), &f.number(content)), f)
    });
    degrees.find_map(|degree| {
        let power = |(value, f): &(Quadratic, &Field)| f.power(value, &Number::integer(degree));
        let number = fingerprint([&power(&first), &power(&second)]).to_likely_rational()?;
        let is_positive = !number.is_zero() && !number.is_negative();
        let whole = content.powi(degree).ok()?.mul(&number);
        is_positive.then(|| (Number::rational(1, degree), whole))
    })
}

/// Bring a matrix to its reduced row echelon form; the columns of the pivots, which are those of the first rows.
fn reduce(matrix: &mut [Vec<Quadratic>], columns: usize, f: &Field) -> Vec<usize> {
    let mut pivots = Vec::new();
    for column in 0..columns {
        let top = pivots.len();
        let Some(found) = (top..matrix.len()).find(|&row| !matrix[row][column].is_zero()) else { continue };
        matrix.swap(top, found);
        let inverse = f.inverse(&matrix[top][column]);
        let pivot: Vec<Quadratic> = matrix[top].iter().map(|value| f.mul(value, &inverse)).collect();
        for (k, row) in matrix.iter_mut().enumerate() {
            if k != top && !row[column].is_zero() {
                let factor = row[column].clone();
                for (value, above) in row.iter_mut().zip(&pivot) {
                    *value = f.sub(value, &f.mul(&factor, above));
                }
            }
        }
        matrix[top] = pivot;
        pivots.push(column);
    }
    pivots
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Error;

    #[test]
    fn exponentials_are_found_in_quotients() -> Result<(), Error> {
        let g = &mut Graph::new();
        let (x, y) = (g.symbol("x", Assumption::Real), g.symbol("y", Assumption::Real));
        let e = g.apply(Function::Exp, &[x])?;
        let (product, next) = (g.mul(e, y)?, g.add(y, Id::ONE));
        let sum = g.add(product, e);
        let quotient = g.div(sum, next)?;
        let logarithm = g.apply(Function::Log, &[quotient])?;
        assert!(g.equal(logarithm, x));
        Ok(())
    }
}
