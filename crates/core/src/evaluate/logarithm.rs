//! Logarithms: log of a product of powers of positive symbols, numbers and exponentials is the sum of their logarithms.

use crate::graph::{Assumption, Atom, Flags, Function, Graph, Id, Monomial, View, draw_logarithm};
use crate::value::{Field, FieldId, Key, Number, Quadratic, prime_factors};

use super::integer_point::IntegerPoint;
use super::logarithm_part::Part;
use super::node::power_of_number;

/// How many factors of factors are opened.
const DEPTH: u32 = 16;

/// The most positive symbols of a product of powers.
const MOST_SYMBOLS: usize = 16;

/// The degrees of roots of numbers in such a product that are tried.
const ROOTS: [i64; 6] = [1, 2, 3, 4, 6, 12];

impl Graph {
    /// What the logarithm of a node needs to be known in a field.
    pub(super) fn push_needed_by_logarithm(&self, id: Id, field: FieldId, out: &mut Vec<(Id, FieldId)>) {
        let Some(parts) = self.logarithm_parts(id) else {
            out.push((id, field));
            return;
        };
        for part in parts {
            match part {
                Part::Exponent(_, node) | Part::Power(_, node, _) => out.push((node, field)),
                Part::Logarithm(..) | Part::Number(..) => {}
            }
        }
    }

    /// The value of log(id) in a field.
    pub(super) fn logarithm_in(&self, id: Id, field: FieldId) -> Quadratic {
        let f = field.field();
        let Some(parts) = self.logarithm_parts(id) else {
            return f.opaque(Key::new("logarithm of"), &[&self.value_in(id, field)]);
        };
        parts.iter().fold(f.number(&Number::integer(0)), |sum, part| {
            let (coefficient, value) = match part {
                Part::Exponent(coefficient, node) => (coefficient, self.value_in(*node, field)),
                Part::Logarithm(coefficient, node) => (coefficient, self.atomic_logarithm(*node, field)),
                Part::Number(coefficient, number) => (coefficient, logarithm_of_number(number, f)),
                Part::Power(coefficient, exponent, base) => (
                    coefficient,
                    f.mul(&self.value_in(*exponent, field), &self.atomic_logarithm(*base, field)),
                ),
            };
            f.add(&sum, &f.mul(&f.number(coefficient), &value))
        })
    }

    /// The atoms in the logarithm of a node: the exponentials of other logarithms have values without them.
    pub(super) fn push_atoms_of_logarithm(&self, id: Id, out: &mut Vec<Atom>) {
        let Some(parts) = self.logarithm_parts(id) else {
            out.push(Atom::Log(id));
            return;
        };
        let mut push_base = |base: Id| match self.view(base) {
            View::Number(number) => {
                let primes = prime_factors(self.get_number(number)).into_keys();
                out.extend(primes.map(Atom::LogOfPrime));
            }
            View::Pi => out.push(Atom::LogOfPi),
            _ => {}
        };
        let mut numbers = Vec::new();
        for part in parts {
            match part {
                Part::Number(_, number) => numbers.push(number),
                Part::Logarithm(_, base) | Part::Power(_, _, base) => push_base(base),
                Part::Exponent(..) => {}
            }
        }
        out.extend(numbers.iter().flat_map(prime_factors).map(|(prime, _)| Atom::LogOfPrime(prime)));
    }

    /// The value of an atom in a field.
    pub(super) fn atom_in(&self, atom: &Atom, field: FieldId) -> Quadratic {
        let f = field.field();
        match atom {
            Atom::Pi => self.value_in(Id::PI, field),
            Atom::Asin(argument) => f.odd(Key::new(Function::Asin.name()), &self.value_in(*argument, field)),
            Atom::Atan(argument) => f.odd(Key::new(Function::Atan.name()), &self.value_in(*argument, field)),
            Atom::Atan2(y, x) => self.direction_in(*y, *x, field),
            Atom::Log(argument) | Atom::Symbol(argument) => self.logarithm_in(*argument, field),
            Atom::LogOfPrime(prime) => logarithm_of_number(&Number::whole(prime.clone()), f),
            Atom::LogOfPi => self.logarithm_in(Id::PI, field),
        }
    }

    /// The parts of the logarithm of a product of positive powers, also of one whose form does not show it.
    pub(super) fn logarithm_parts(&self, id: Id) -> Option<Vec<Part>> {
        let mut parts = Vec::new();
        if self.split_logarithm(id, &Number::integer(1), DEPTH, &mut parts) {
            return Some(parts);
        }
        let (number, root, powers) = self.monomial(id)?;
        let numbers = std::iter::once(Part::Number(root, number));
        Some(
            numbers
                .chain(powers.into_iter().map(|(symbol, exponent)| Part::Logarithm(exponent, symbol)))
                .collect(),
        )
    }

    /// The root of a number and the powers of positive symbols whose product has the value of a node, if there are such.
    ///
    /// The powers are read off at a point of integers, and the product is compared in all lanes.
    fn monomial(&self, id: Id) -> Option<Monomial> {
        if let Some(known) = self.lanes.borrow().monomial(id) {
            return known.clone();
        }
        let monomial = self.find_monomial(id);
        self.lanes.borrow_mut().insert_monomial(id, monomial.clone());
        monomial
    }

    fn find_monomial(&self, id: Id) -> Option<Monomial> {
        if self.flags(id).has(Flags::COMPLEX) || self.as_number(id).is_some() {
            return None;
        }
        let (degree, number) = ROOTS.into_iter().find_map(|degree| {
            let power = self.power_at_integers(id, degree, IntegerPoint::PLAIN)?;
            (!power.is_zero() && !power.is_negative()).then_some((degree, power))
        })?;
        let symbols = self
            .variables(&[id])
            .into_iter()
            .filter(|&variable| matches!(self.view(variable), View::Symbol(_, Assumption::Positive)));
        let mut powers = Vec::new();
        for symbol in std::iter::once(Id::PI).chain(symbols.take(MOST_SYMBOLS)) {
            let atom = if symbol == Id::PI { Atom::Pi } else { Atom::Symbol(symbol) };
            let exponent = self.doublings_at_integers(id, &atom)?;
            if exponent != 0 {
                powers.push((symbol, Number::rational(exponent, 12)));
            }
        }
        let root = Number::rational(1, degree);
        let product = |field: FieldId| {
            let f = field.field();
            let start = power_of_number(&number, &root, f);
            powers.iter().fold(start, |product, (symbol, exponent)| {
                f.mul(&product, &self.power_in(*symbol, exponent, field))
            })
        };
        let same_in_hash_lanes =
            FieldId::HASH.into_iter().all(|field| self.value_in(id, field) == product(field));
        (same_in_hash_lanes && self.is_everywhere(id, product)).then_some((number, root, powers))
    }

    fn atomic_logarithm(&self, id: Id, field: FieldId) -> Quadratic {
        let f = field.field();
        match self.view(id) {
            View::Symbol(name, _) => draw_logarithm(field, name),
            View::Number(number) => logarithm_of_number(self.get_number(number), f),
            _ => f.draw(&Key::new("logarithm of pi")),
        }
    }

    /// Split the logarithm of a product of positive powers; whether the node is one.
    fn split_logarithm(&self, id: Id, coefficient: &Number, depth: u32, out: &mut Vec<Part>) -> bool {
        let Some(deeper) = depth.checked_sub(1) else { return false };
        match self.view(id) {
            View::Number(number) if id == Id::ZERO || self.get_number(number).is_negative() => false,
            View::Number(number) => {
                out.push(Part::Number(coefficient.clone(), self.get_number(number).clone()));
                true
            }
            View::Pi | View::Symbol(_, Assumption::Positive) => {
                out.push(Part::Logarithm(coefficient.clone(), id));
                true
            }
            View::Scale(factor, child) if !self.get_number(factor).is_negative() => {
                out.push(Part::Number(coefficient.clone(), self.get_number(factor).clone()));
                self.split_logarithm(child, coefficient, deeper, out)
            }
            View::Product(factors) => factors.iter().all(|(base, exponent)| {
                let coefficient = coefficient.mul(self.get_number(exponent));
                self.split_logarithm(base, &coefficient, deeper, out)
            }),
            View::Function(Function::Exp, args)
                if !self.flags(id).has(Flags::COMPLEX) && !self.may_be_negative(args.get(0)) =>
            {
                out.push(Part::Exponent(coefficient.clone(), args.get(0)));
                true
            }
            View::Function(Function::Power, args)
                if matches!(
                    self.view(args.get(0)),
                    View::Symbol(_, Assumption::Positive) | View::Number(_)
                ) && !self.flags(id).has(Flags::COMPLEX) =>
            {
                out.push(Part::Power(coefficient.clone(), args.get(1), args.get(0)));
                true
            }
            _ => false,
        }
    }
}

/// The sum of the logarithms of the prime factors.
fn logarithm_of_number(number: &Number, f: &Field) -> Quadratic {
    prime_factors(number).iter().fold(f.number(&Number::integer(0)), |sum, (prime, &count)| {
        let logarithm = f.draw(&Key::new("logarithm of a prime").text(&prime.to_string()));
        f.add(&sum, &f.mul(&f.number(&Number::integer(count)), &logarithm))
    })
}
