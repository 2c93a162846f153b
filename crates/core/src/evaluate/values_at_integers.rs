//! The value of a node at a point of integers in a field, from those of its children.

use crate::graph::{Assumption, Atom, Function, Generator, Graph, Id, Split, View};
use crate::interrupt::tick;
use crate::value::{Field, FieldId, Number, Quadratic, prime_factors};

use super::integer_point::{IntegerPoint, Values};
use super::logarithm_part::Part;

impl Graph {
    /// The values of nodes in the first field of a lane, but of those that have a pole.
    pub(super) fn values_at(&self, order: &[Id], point: IntegerPoint<'_>, field: FieldId) -> Values {
        let mut values = Values::default();
        for &id in order {
            tick();
            // A pole does no harm inside functions that do not ask for its value.
            if let Some(value) = self.value_at(id, point, &values, field) {
                values.insert(id, value);
            }
        }
        values
    }

    fn value_at(
        &self,
        id: Id,
        point: IntegerPoint<'_>,
        values: &Values,
        field: FieldId,
    ) -> Option<Quadratic> {
        let f = field.field();
        let integer = |n: i64| f.number(&Number::integer(n));
        match self.view(id) {
            View::Number(number) => Some(f.number(self.get_number(number))),
            View::Pi => Some(point.pi(f)),
            View::Symbol(_, Assumption::Positive) => Some(point.grow(Generator::Symbol(id), &f.one(), f)),
            View::Time | View::Symbol(..) | View::TimeFunction(..) | View::Application { .. } => {
                Some(integer(point.integer_of(self.value(id))))
            }
            View::Function(function, _) if point.draws_functions() && !function.is_choice() => {
                let (unsigned, negated) = self.value(id).unsigned();
                let drawn = point.integer_of(unsigned);
                Some(integer(if negated { -drawn } else { drawn }))
            }
            View::Scale(number, child) => {
                Some(f.mul(&f.number(self.get_number(number)), values.get(&child)?))
            }
            View::Sum(terms) => {
                terms.iter().try_fold(f.number(&Number::integer(0)), |sum, (number, node)| {
                    Some(f.add(&sum, &f.mul(&f.number(self.get_number(number)), values.get(&node)?)))
                })
            }
            View::Product(factors) => factors.iter().try_fold(f.one(), |product, (base, exponent)| {
                let exponent = self.get_number(exponent);
                let base = if exponent.is_integer() { base } else { self.representative(base) };
                let value = values.get(&base)?;
                if value.is_zero() && exponent.is_negative() {
                    return point.poles_are_zero.then(|| value.clone());
                }
                let power = self.power_of(base, value, exponent, f);
                let product = f.mul(&product, &power);
                Some(match point.conjugation {
                    Some(conjugation) if !exponent.is_integer() => {
                        f.mul(&product, &f.unit(&conjugation.turn_of(base, exponent)))
                    }
                    _ => product,
                })
            }),
            View::Function(function, args) => {
                let args: Vec<Id> = self.represented(args).collect();
                self.function_at(function, &args, point, values, field)
            }
            View::LinearSystem { .. } | View::Solution(..) => None,
        }
    }

    fn function_at(
        &self,
        function: Function,
        args: &[Id],
        point: IntegerPoint<'_>,
        values: &Values,
        field: FieldId,
    ) -> Option<Quadratic> {
        let f = field.field();
        let of = |id: Id| values.get(&id);
        let integer = |n: i64| f.number(&Number::integer(n));
        Some(match function {
            Function::Sin => self.angle_at(args[0], point, values, field)?.1,
            Function::Cos => self.angle_at(args[0], point, values, field)?.0,
            Function::Tan => {
                let (cos, sin) = self.angle_at(args[0], point, values, field)?;
                f.div(&sin, &cos)
            }
            Function::Exp => self.exponential_at(args[0], point, values, field)?,
            Function::Sinh | Function::Cosh | Function::Tanh => {
                let exponential = self.exponential_at(args[0], point, values, field)?;
                let inverse = f.inverse(&exponential);
                let (sinh, cosh) =
                    (f.half(&f.sub(&exponential, &inverse)), f.half(&f.add(&exponential, &inverse)));
                match function {
                    Function::Sinh => sinh,
                    Function::Cosh => cosh,
                    _ => f.div(&sinh, &cosh),
                }
            }
            Function::Log => self.logarithm_at(args[0], point, values, field)?,
            Function::Asin => integer(point.inverse(self, &Atom::Asin(args[0]))),
            Function::Acos => {
                let asin = integer(point.inverse(self, &Atom::Asin(args[0])));
                f.sub(&f.half(&point.pi(f)), &asin)
            }
            Function::Atan => integer(point.inverse(self, &Atom::Atan(args[0]))),
            Function::Atan2 => integer(point.inverse(self, &Atom::Atan2(args[0], args[1]))),
            Function::Abs if self.has_modulus_at(args[0], of(args[0])?) => f.absolute_value(of(args[0])?),
            Function::Abs => f.mul(of(args[0])?, &self.sign_at(args[0], of(args[0])?, point, f)),
            Function::Sign if self.has_modulus_at(args[0], of(args[0])?) => {
                f.div(of(args[0])?, &f.absolute_value(of(args[0])?))
            }
            Function::Sign => self.sign_at(args[0], of(args[0])?, point, f),
            Function::Min | Function::Max => {
                args.iter().try_for_each(|&arg| of(arg).map(drop))?;
                let chosen = match point.lane() {
                    Some(lane) => {
                        self.extremum_in(function, args, |arg| self.value_in(arg, lane), lane.field())
                    }
                    None => self.extremum_in(function, args, |arg| values[&arg].clone(), f),
                };
                values[&chosen].clone()
            }
            Function::Power => {
                let generator = Generator::Power { base: args[0], exponent: args[1] };
                let values = point.values_for(&generator, values);
                let base = values.get(&args[0])?;
                point.grow(generator, &power(base, &self.number_in_at(args[1], point), f)?, f)
            }
            Function::Piecewise => {
                let all: Option<Vec<&Quadratic>> = args.iter().map(|&arg| of(arg)).collect();
                let all: Vec<Quadratic> = all?.into_iter().cloned().collect();
                let signs: Vec<Quadratic> =
                    args.iter().zip(&all).map(|(&arg, value)| self.sign_at(arg, value, point, f)).collect();
                f.piecewise(&all, &signs)
            }
        })
    }

    /// Whether a node that has this value has no sign there.
    fn has_modulus_at(&self, id: Id, value: &Quadratic) -> bool {
        !value.is_real() && !self.has_real_values(id)
    }

    /// The sign of a node that has this value, or that in the lane of the point.
    fn sign_at(&self, id: Id, value: &Quadratic, point: IntegerPoint<'_>, f: &Field) -> Quadratic {
        match point.lane() {
            Some(lane) if self.is_negative_in(id, lane) => f.neg(&f.one()),
            Some(_) => f.one(),
            None => self.sign_of(id, value, f),
        }
    }

    /// The cosine and the sine of the known angles in an argument.
    fn angle_at(
        &self,
        argument: Id,
        point: IntegerPoint<'_>,
        values: &Values,
        field: FieldId,
    ) -> Option<(Quadratic, Quadratic)> {
        let f = field.field();
        let split = self.split_at(argument, false, point);
        let needed = split.iter().flat_map(|(atom, _)| atom.arguments());
        let is_known = needed.into_iter().all(|id| values.contains_key(&id));
        let start = (f.one(), f.number(&Number::integer(0)));
        is_known.then(|| self.rotated(start, &split, f, |id| values[&id].clone()))
    }

    fn split_at(&self, argument: Id, of_exponential: bool, point: IntegerPoint<'_>) -> Split {
        match point.lane() {
            Some(lane) => self.split_in(argument, of_exponential, lane),
            None => self.split_argument(argument, of_exponential),
        }
    }

    /// The exponential of the logarithms in an argument.
    fn exponential_at(
        &self,
        argument: Id,
        point: IntegerPoint<'_>,
        values: &Values,
        field: FieldId,
    ) -> Option<Quadratic> {
        let f = field.field();
        let generator = Generator::Exponential(argument);
        let is_generator = point.grows(&generator);
        let values = point.values_for(&generator, values);
        let split = self.split_at(argument, true, point);
        let plain = split.iter().try_fold(f.one(), |product, (atom, factor)| {
            let base = match atom {
                Atom::Log(argument) => values.get(argument)?.clone(),
                Atom::LogOfPrime(prime) => f.number(&Number::whole(prime.clone())),
                _ if is_generator => f.one(),
                _ => point.pi(f),
            };
            Some(f.mul(&product, &power(&base, &self.factor_at(argument, atom, factor, point), f)?))
        });
        Some(point.grow(generator, &plain?, f))
    }

    /// The number in an exponent at one of several points: what 2^y - 7 is at all of them is no multiple of a prime.
    fn number_in_at(&self, exponent: Id, point: IntegerPoint<'_>) -> Number {
        let own =
            (!point.is_first()).then(|| self.at_integers(exponent, IntegerPoint::numbered(point.number)));
        own.flatten().unwrap_or_else(|| match point.lane() {
            Some(lane) => self.number_in_lane(exponent, lane),
            None => self.number_in(exponent),
        })
    }

    /// The factor of an atom in an argument, likewise.
    fn factor_at(&self, argument: Id, atom: &Atom, plain: &Number, point: IntegerPoint<'_>) -> Number {
        let own = (!point.is_first())
            .then(|| self.growth_at_integers(argument, atom, IntegerPoint::numbered(point.number)));
        own.flatten().unwrap_or_else(|| plain.clone())
    }

    /// The sum of the parts of a logarithm: those of positive symbols are zero.
    fn logarithm_at(
        &self,
        argument: Id,
        point: IntegerPoint<'_>,
        values: &Values,
        field: FieldId,
    ) -> Option<Quadratic> {
        let f = field.field();
        let Some(parts) = self.logarithm_parts(argument) else {
            let is_it = |atom: &Atom| matches!(atom, Atom::Log(known) if self.same(*known, argument));
            return Some(f.number(&Number::integer(point.replaced(is_it).unwrap_or(0))));
        };
        let of_prime = |number: &Number| match point.atom {
            Some((Atom::LogOfPrime(prime), value)) => {
                value * prime_factors(number).get(prime).copied().unwrap_or(0)
            }
            _ => 0,
        };
        let of_base = |base: Id| match base {
            Id::PI => point.replaced(|atom| *atom == Atom::LogOfPi).unwrap_or(0),
            _ => 0,
        };
        let integer = |n: i64| f.number(&Number::integer(n));
        parts.iter().try_fold(integer(0), |sum, part| {
            let (coefficient, value) = match part {
                Part::Exponent(coefficient, node) => (coefficient, values.get(node)?.clone()),
                Part::Logarithm(coefficient, node) => (coefficient, integer(of_base(*node))),
                Part::Number(coefficient, number) => (coefficient, integer(of_prime(number))),
                Part::Power(coefficient, exponent, base) => {
                    let logarithm = self.logarithm_at(*base, point, values, field)?;
                    if logarithm.is_zero() {
                        return Some(sum); // whatever the exponent is
                    }
                    (coefficient, f.mul(values.get(exponent)?, &logarithm))
                }
            };
            Some(f.add(&sum, &f.mul(&f.number(coefficient), &value)))
        })
    }
}

/// A rational power; `None` at a pole.
fn power(base: &Quadratic, exponent: &Number, f: &Field) -> Option<Quadratic> {
    if base.is_zero() && exponent.is_negative() {
        return None;
    }
    Some(f.rational_power(base, exponent))
}
