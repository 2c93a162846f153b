//! Powers with rational exponents in a field: of nodes, and of numbers by their primes.

use num_bigint::BigInt;

use crate::graph::{Assumption, Content, Graph, Id, Kind};
use crate::value::{Field, FieldId, Key, LARGEST_SQUARE, Number, Quadratic, prime_factors};

impl Graph {
    /// The principal power of a node with a rational exponent.
    pub(super) fn power_in(&self, base: Id, exponent: &Number, field: FieldId) -> Quadratic {
        let f = field.field();
        if exponent.is_one() {
            return self.value_in(base, field);
        }
        if exponent.is_integer() {
            return match self.powers_of_represented_roots(base, exponent) {
                Some(powers) => self.product_in(powers.into_iter(), field),
                None => f.power(&self.value_in(base, field), exponent),
            };
        }
        let base = self.representative(base);
        match exponent.to_small() {
            Some((num, den)) => {
                let root = self.root_in(base, den * num.signum(), field);
                f.power(&root, &Number::integer(num).abs())
            }
            None => self.principal_power_in(base, exponent, field),
        }
    }

    /// The root of a degree, or the reciprocal root of a negative degree. One root serves all powers of a node.
    fn root_in(&self, base: Id, degree: i64, field: FieldId) -> Quadratic {
        if let Some(known) = self.lanes.borrow().root(base, degree, field) {
            return known.clone();
        }
        let exponent = Number::rational(1, degree);
        let root = self.principal_power_in(base, &exponent, field);
        self.lanes.borrow_mut().insert_root(base, degree, field, root.clone());
        root
    }

    /// The principal power of a node, or some branch of it for a complex node: the same one in all fields of a lane.
    fn principal_power_in(&self, base: Id, exponent: &Number, field: FieldId) -> Quadratic {
        let (value, f) = (self.value_in(base, field), field.field());
        if self.as_number(base).is_some() || !self.is_complex(base) {
            return self.power_of(base, &value, exponent, f);
        }
        let signs = field.of_signs();
        power_on_branch(&value, exponent, branch_of(&self.value_in(base, signs), signs.field()), f)
    }

    /// The principal power of a node that has this value.
    pub(super) fn power_of(&self, base: Id, value: &Quadratic, exponent: &Number, f: &Field) -> Quadratic {
        if exponent.is_integer() {
            return f.power(value, exponent);
        }
        if let Some(number) = self.as_number(base) {
            return power_of_number(number, exponent, f);
        }
        if self.is_complex(base) {
            return power_of_complex(value, exponent, f);
        }
        power_beside_content(value, self.numeric_content(base, f), exponent, f)
    }

    /// Whether a power has signs that differ from lane to lane: a root of something that is not known to be positive.
    pub(crate) fn is_branching(&self, base: Id, exponent: &Number) -> bool {
        if exponent.is_integer() || matches!(self.kind(base), Kind::Symbol(Assumption::Positive) | Kind::Pi) {
            return false;
        }
        self.as_number(base).is_none_or(|number| prime_factors(number).keys().any(is_large))
    }

    /// The same for a symbolic exponent.
    pub(crate) fn is_branching_power(&self, base: Id, exponent: Id) -> bool {
        self.logarithm_parts(base).is_none() || self.is_branching(base, &self.number_in(exponent))
    }
}

/// A rational power of what may be complex, on the branch that is drawn for this value.
pub(super) fn power_of_complex(value: &Quadratic, exponent: &Number, f: &Field) -> Quadratic {
    power_on_branch(value, exponent, branch_of(value, f), f)
}

/// The k of the factor e^(2 pi i k r) of a power r of this value, the same one for all exponents.
fn branch_of(value: &Quadratic, f: &Field) -> u64 {
    f.exponent(&f.opaque(Key::new("branch"), &[value]))
}

fn power_on_branch(value: &Quadratic, exponent: &Number, branch: u64, f: &Field) -> Quadratic {
    let turns = exponent.mul(&Number::whole(branch.into()));
    f.mul(&f.rational_power(value, exponent), &f.unit(&turns))
}

/// Whether a prime may be no square in some lanes.
pub(super) fn is_large(prime: &BigInt) -> bool {
    *prime > LARGEST_SQUARE.into()
}

/// The principal power of a number: the product of the powers of its primes and of -1.
pub(super) fn power_of_number(number: &Number, exponent: &Number, f: &Field) -> Quadratic {
    let start = if number.is_negative() { f.power_of_minus_one(exponent) } else { f.one() };
    prime_factors(&number.abs()).iter().fold(start, |product, (prime, &count)| {
        let exponent = exponent.mul(&Number::integer(count));
        f.mul(&product, &f.power_of_prime(&Number::whole(prime.clone()), &exponent))
    })
}

/// The power of what is real and has a content, which is taken out.
pub(super) fn power_beside_content(
    value: &Quadratic,
    content: Option<Content>,
    exponent: &Number,
    f: &Field,
) -> Quadratic {
    let Some(content) = content else { return f.rational_power(value, exponent) };
    let rest = f.div(value, &power_of_content(&content, &Number::integer(1), f));
    f.mul(&power_of_content(&content, exponent, f), &f.rational_power(&rest, exponent))
}

/// The power of a content in a field.
pub(super) fn power_of_content(content: &Content, exponent: &Number, f: &Field) -> Quadratic {
    content.iter().fold(f.one(), |product, (prime, power)| {
        f.mul(&product, &power_of_prime(prime, &power.mul(exponent), f))
    })
}

/// The power of a prime number in a field.
pub(super) fn power_of_prime(prime: &BigInt, exponent: &Number, f: &Field) -> Quadratic {
    let prime = Number::whole(prime.clone());
    if exponent.is_integer() {
        f.power(&f.number(&prime), exponent)
    } else {
        f.power_of_prime(&prime, exponent)
    }
}
