//! Logarithms: log of a product of powers of positive symbols, numbers and exponentials is the sum of their logarithms.

use crate::graph::{Assumption, Atom, Function, Generator, Graph, Id, Monomial, View, draw_logarithm};
use crate::value::{Field, FieldId, Key, Number, Quadratic, prime_factors};

use super::logarithm_part::Part;

/// How many factors of factors are opened.
pub(super) const DEPTH: u32 = 16;

impl Graph {
    /// What the logarithm of a node needs to be known in a field.
    pub(super) fn push_needed_by_logarithm(&self, id: Id, field: FieldId, out: &mut Vec<(Id, FieldId)>) {
        let Some(parts) = self.logarithm_parts_in(id, field) else {
            out.push((id, field.unturned()));
            out.extend(field.turned_by().map(|by| (id, by)));
            return;
        };
        for part in parts {
            match part {
                Part::Exponent(_, node) => out.push((node, field)),
                Part::Power(_, exponent, base) => {
                    out.push((exponent, field));
                    self.push_needed_by_logarithm(base, field, out);
                }
                Part::Logarithm(..) | Part::Number(..) => {}
            }
        }
    }

    /// The value of log(id) in a field.
    pub(super) fn logarithm_in(&self, id: Id, field: FieldId) -> Quadratic {
        let f = field.field();
        let Some(parts) = self.logarithm_parts_in(id, field) else {
            let drawn = f.opaque(Key::new("logarithm of"), &[&self.value_in(id, field.unturned())]);
            let is_turned = field.turned_by().is_some_and(|by| self.is_negative_in(id, by));
            return if is_turned { f.add(&drawn, &self.value_in(Id::PI, field)) } else { drawn };
        };
        parts.iter().fold(f.number(&Number::integer(0)), |sum, part| {
            let (coefficient, value) = match part {
                Part::Exponent(coefficient, node) => (coefficient, self.value_in(*node, field)),
                Part::Logarithm(coefficient, node) => (coefficient, self.atomic_logarithm(*node, field)),
                Part::Number(coefficient, number) => (coefficient, logarithm_of_number(number, f)),
                Part::Power(coefficient, exponent, base) => {
                    (coefficient, f.mul(&self.value_in(*exponent, field), &self.logarithm_in(*base, field)))
                }
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
        for part in parts {
            match part {
                Part::Number(_, number) => {
                    out.extend(prime_factors(&number).into_keys().map(Atom::LogOfPrime));
                }
                Part::Logarithm(_, Id::PI) => out.push(Atom::LogOfPi),
                Part::Power(_, _, base) => self.push_atoms_of_logarithm(base, out),
                Part::Logarithm(..) | Part::Exponent(..) => {}
            }
        }
    }

    /// The value of an atom in a field.
    pub(super) fn atom_in(&self, atom: &Atom, field: FieldId) -> Quadratic {
        let f = field.field();
        match atom {
            Atom::Pi => self.value_in(Id::PI, field),
            Atom::Asin(argument) => f.odd(Key::new(Function::Asin.name()), &self.value_in(*argument, field)),
            Atom::Atan(argument) => f.odd(Key::new(Function::Atan.name()), &self.value_in(*argument, field)),
            Atom::Atan2(y, x) => self.direction_in(*y, *x, field),
            Atom::Log(argument) => self.logarithm_in(*argument, field),
            Atom::LogOfPrime(prime) => logarithm_of_number(&Number::whole(prime.clone()), f),
            Atom::LogOfPi => self.logarithm_in(Id::PI, field),
        }
    }

    /// The parts of the logarithm of a product of positive powers, also of one whose form does not show it.
    pub(super) fn logarithm_parts(&self, id: Id) -> Option<Vec<Part>> {
        let id = self.representative(id);
        let mut parts = Vec::new();
        if self.split_logarithm(id, &Number::integer(1), DEPTH, &mut parts) {
            return Some(parts);
        }
        self.monomial(id).map(parts_of_monomial)
    }

    /// The parts where signs are those of a lane: the logarithm of a piecewise function is that of a branch.
    fn logarithm_parts_in(&self, id: Id, field: FieldId) -> Option<Vec<Part>> {
        let known = self.logarithm_parts(id);
        known.or_else(|| self.monomial_in(id, field.of_signs()).map(parts_of_monomial))
    }

    pub(super) fn atomic_logarithm(&self, id: Id, field: FieldId) -> Quadratic {
        match self.view(id) {
            View::Symbol(name, _) => draw_logarithm(field, name),
            _ => field.draw(&Key::new("logarithm of pi")),
        }
    }

    /// Whether the logarithm of a node is known.
    pub(super) fn is_monomial(&self, id: Id, depth: u32) -> bool {
        self.split_logarithm(id, &Number::integer(1), depth, &mut Vec::new()) || self.monomial(id).is_some()
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
                if !self.is_complex(id) && !self.may_be_negative(args.get(0)) =>
            {
                out.push(Part::Exponent(coefficient.clone(), self.representative(args.get(0))));
                true
            }
            View::Function(Function::Power, args)
                if !self.is_complex(id) && self.is_monomial(args.get(0), deeper) =>
            {
                let [base, exponent] = [0, 1].map(|place| self.representative(args.get(place)));
                out.push(Part::Power(coefficient.clone(), exponent, base));
                true
            }
            _ => false,
        }
    }
}

fn parts_of_monomial(Monomial { number, root, powers }: Monomial) -> Vec<Part> {
    let powers = powers.into_iter().map(|(generator, coefficient)| match generator {
        Generator::Symbol(symbol) => Part::Logarithm(coefficient, symbol),
        Generator::Exponential(argument) => Part::Exponent(coefficient, argument),
        Generator::Power { base, exponent } => Part::Power(coefficient, exponent, base),
    });
    std::iter::once(Part::Number(root, number)).chain(powers).collect()
}

/// The sum of the logarithms of the prime factors.
fn logarithm_of_number(number: &Number, f: &Field) -> Quadratic {
    prime_factors(number).iter().fold(f.number(&Number::integer(0)), |sum, (prime, &count)| {
        let logarithm = f.draw(&Key::new("logarithm of a prime").text(&prime.to_string()));
        f.add(&sum, &f.mul(&f.number(&Number::integer(count)), &logarithm))
    })
}
