//! The values of nodes at points of the q-adic integers, where variables and functions are drawn.
//!
//! At the first points the argument of a sine or an exponential is zero but for its atoms (see [`argument`](super::argument)),
//! whose angles and exponentials are known, so that the addition theorems hold. At the others it is drawn (see
//! [`drawn_argument`](super::drawn_argument)). Signs are those of a lane.

use rustc_hash::FxHashMap;

use crate::graph::{Atom, Function, Graph, Id, View};
use crate::interrupt::tick;
use crate::value::{Adic, Adics, Coefficient, Key, Number};

use super::adic_point::AdicPoint;
use super::logarithm_part::Part;
use super::rotation::{self, multiple, rotate};

type Point<C> = rotation::Point<Adic<C>>;
type Values<C> = FxHashMap<Id, Adic<C>>;

impl Graph {
    /// The nodes from whose values that of a node is found; none if it is drawn.
    pub(super) fn push_adic_parts(&self, id: Id, out: &mut Vec<Id>) {
        match self.view(id) {
            View::Scale(..) | View::Sum(_) | View::Product(_) => self.push_parts(id, out),
            View::Function(function, args) if !self.is_complex(id) => match function {
                _ if function.is_choice() => self.push_parts(id, out),
                Function::Power => out.push(self.representative(args.get(0))),
                _ => {
                    if let Some(of_exponential) = of_exponential(function) {
                        let split = self.split_argument(args.get(0), of_exponential);
                        out.extend(split.iter().flat_map(|(atom, _)| atom.arguments()));
                    }
                }
            },
            _ => {}
        }
    }

    /// The numbers of which a node holds powers without holding these numbers, such as the 3 of exp(x*log(9)).
    pub(super) fn adic_bases(&self, id: Id) -> Vec<Number> {
        let View::Function(function, args) = self.view(id) else { return Vec::new() };
        if of_exponential(function) != Some(true) {
            return Vec::new();
        }
        let split = self.split_argument(args.get(0), true);
        let base = |atom: &Atom| match atom {
            Atom::LogOfPrime(prime) => Some(Number::whole(prime.clone())),
            _ => None,
        };
        split.iter().filter_map(|(atom, _)| base(atom)).collect()
    }

    /// The values of nodes that stand after their parts.
    pub(super) fn adic_values<C: Coefficient>(&self, order: &[Id], at: &AdicPoint<'_, C>) -> Values<C> {
        let mut values = Values::default();
        for &node in order {
            tick();
            let value = self.adic_value(node, &values, at);
            values.insert(node, value);
        }
        values
    }

    fn adic_value<C: Coefficient>(&self, node: Id, values: &Values<C>, at: &AdicPoint<'_, C>) -> Adic<C> {
        let adics = at.adics;
        match self.view(node) {
            View::Number(number) => adics.rational(self.get_number(number)),
            View::Scale(number, child) => {
                adics.mul(&adics.rational(self.get_number(number)), &values[&child])
            }
            View::Sum(terms) => terms.iter().fold(Adics::zero(), |sum, (number, node)| {
                let factor = adics.rational(self.get_number(number));
                adics.add(&sum, &adics.mul(&factor, &values[&node]))
            }),
            View::Product(factors) => factors.iter().fold(at.one(), |product, (base, exponent)| {
                adics.mul(&product, &self.adic_power(base, self.get_number(exponent), values, at))
            }),
            View::Function(function, args) if !self.is_complex(node) => {
                let args: Vec<Id> = self.represented(args).collect();
                self.adic_function(function, &args, values, at).unwrap_or_else(|| self.drawn_adic(node, at))
            }
            _ => self.drawn_adic(node, at),
        }
    }

    /// The value of a part; one that only shows where signs are those of a lane is drawn.
    fn adic_part<C: Coefficient>(&self, id: Id, values: &Values<C>, at: &AdicPoint<'_, C>) -> Adic<C> {
        values.get(&id).cloned().unwrap_or_else(|| self.drawn_adic(id, at))
    }

    /// A unit, and its opposite for the opposite value.
    fn drawn_adic<C: Coefficient>(&self, node: Id, at: &AdicPoint<'_, C>) -> Adic<C> {
        let (_, is_opposite) = self.value(node).unsigned();
        let drawn = at.adics.draw(&at.key_of(|field| self.value_in(node, field)));
        if is_opposite { at.adics.mul(&drawn, &at.adics.integer(&(-1).into())) } else { drawn }
    }

    /// The value of a function; `None` if it is drawn.
    fn adic_function<C: Coefficient>(
        &self,
        function: Function,
        args: &[Id],
        values: &Values<C>,
        at: &AdicPoint<'_, C>,
    ) -> Option<Adic<C>> {
        let adics = at.adics;
        if function.is_choice() {
            return Some(self.adic_choice(function, args, values, at));
        }
        let is_plain = at.has_plain_arguments();
        let angle = || {
            if is_plain { Some(self.adic_angle(args[0], values, at)) } else { self.drawn_angle(args[0], at) }
        };
        let exponential = || {
            if is_plain {
                Some(self.adic_exponential(args[0], values, at))
            } else {
                self.drawn_exponential(args[0], at)
            }
        };
        let quotient = |a: &Adic<C>, b: &Adic<C>| adics.mul(a, &adics.power(b, -1));
        Some(match function {
            Function::Sin => angle()?.1,
            Function::Cos => angle()?.0,
            Function::Tan => {
                let (cos, sin) = angle()?;
                quotient(&sin, &cos)
            }
            Function::Exp => exponential()?,
            Function::Sinh | Function::Cosh | Function::Tanh => {
                let exponential = exponential()?;
                let inverse = adics.power(&exponential, -1);
                let minus = adics.mul(&adics.integer(&(-1).into()), &inverse);
                let (sinh, cosh) = (adics.add(&exponential, &minus), adics.add(&exponential, &inverse));
                match function {
                    Function::Sinh => at.half(&sinh),
                    Function::Cosh => at.half(&cosh),
                    _ => quotient(&sinh, &cosh),
                }
            }
            Function::Power if is_plain => {
                let number = self.number_in_lane(args[1], at.lane());
                self.adic_general_power(args[0], &number, values, at)
            }
            _ => return None,
        })
    }

    fn adic_power<C: Coefficient>(
        &self,
        base: Id,
        exponent: &Number,
        values: &Values<C>,
        at: &AdicPoint<'_, C>,
    ) -> Adic<C> {
        let base = if exponent.is_integer() { base } else { self.representative(base) };
        at.power(&self.adic_part(base, values, at), exponent, |field| self.value_in(base, field))
    }

    /// A power whose exponent is a number here: that of the numbers in a positive base, as an exponential has it, in
    /// whose argument the logarithms of positive symbols belong to the rest.
    fn adic_general_power<C: Coefficient>(
        &self,
        base: Id,
        exponent: &Number,
        values: &Values<C>,
        at: &AdicPoint<'_, C>,
    ) -> Adic<C> {
        let numbers = self.logarithm_parts(base).and_then(|parts| {
            let number = |part| match part {
                Part::Number(coefficient, number) => Some(Some((coefficient, number))),
                Part::Logarithm(_, symbol) if symbol != Id::PI => Some(None),
                _ => None,
            };
            parts.into_iter().map(number).collect::<Option<Vec<_>>>()
        });
        let Some(numbers) = numbers else { return self.adic_power(base, exponent, values, at) };
        numbers.into_iter().flatten().fold(at.one(), |product, (coefficient, number)| {
            let value = at.adics.rational(&number);
            let power = at.power(&value, &coefficient.mul(exponent), |field| field.field().number(&number));
            at.adics.mul(&product, &power)
        })
    }

    /// The cosine and the sine of an argument whose rest is zero.
    fn adic_angle<C: Coefficient>(
        &self,
        argument: Id,
        values: &Values<C>,
        at: &AdicPoint<'_, C>,
    ) -> Point<C> {
        let split = self.split_in(argument, false, at.lane());
        let start = (at.one(), Adics::zero());
        split.iter().fold(start, |sum, (atom, factor)| {
            rotate(at.adics, &sum, &self.adic_known_angle(atom, factor, values, at))
        })
    }

    /// A multiple of the angle that an atom is.
    fn adic_known_angle<C: Coefficient>(
        &self,
        atom: &Atom,
        factor: &Number,
        values: &Values<C>,
        at: &AdicPoint<'_, C>,
    ) -> Point<C> {
        let adics = at.adics;
        let halves = factor.mul(&Number::integer(2));
        let Some(count) = halves.to_i64() else {
            let draw = |name| adics.draw(&at.key(Key::new(name).text(&factor.to_string())));
            return (draw("cosine of a part of pi"), draw("sine of a part of pi"));
        };
        let point = match *atom {
            Atom::Asin(sin) => {
                let square = Square { sign: -1, of: [None, Some(sin)] };
                (self.adic_length(&square, values, at), self.adic_part(sin, values, at))
            }
            Atom::Atan(tan) => {
                let square = Square { sign: 1, of: [None, Some(tan)] };
                let cos = adics.power(&self.adic_length(&square, values, at), -1);
                let sin = adics.mul(&cos, &self.adic_part(tan, values, at));
                (cos, sin)
            }
            Atom::Atan2(y, x) => {
                let square = Square { sign: 1, of: [Some(x), Some(y)] };
                let scale = adics.power(&self.adic_length(&square, values, at), -1);
                [x, y].map(|id| adics.mul(&scale, &self.adic_part(id, values, at))).into()
            }
            _ => return multiple(adics, (Adics::zero(), at.one()), count), // pi is two right angles
        };
        match factor.to_i64() {
            Some(count) => multiple(adics, point, count),
            None => multiple(adics, self.adic_half_angle(atom, &point, at), count),
        }
    }

    /// The root of a sum or difference of squares.
    fn adic_length<C: Coefficient>(
        &self,
        square: &Square,
        values: &Values<C>,
        at: &AdicPoint<'_, C>,
    ) -> Adic<C> {
        let adics = at.adics;
        let [first, second] =
            square.of.map(|id| id.map_or_else(|| at.one(), |id| self.adic_part(id, values, at)));
        let second = adics.mul(&adics.integer(&square.sign.into()), &adics.mul(&second, &second));
        let sum = adics.add(&adics.mul(&first, &first), &second);
        at.power(&sum, &Number::rational(1, 2), |field| {
            let f = field.field();
            let [first, second] =
                square.of.map(|id| id.map_or_else(|| f.one(), |id| self.value_in(id, field)));
            let second = f.mul(&f.number(&Number::integer(square.sign)), &f.mul(&second, &second));
            f.add(&f.mul(&first, &first), &second)
        })
    }

    /// Half of the angle of an atom: the cosine is sqrt((1 + cos)/2).
    fn adic_half_angle<C: Coefficient>(
        &self,
        atom: &Atom,
        point: &Point<C>,
        at: &AdicPoint<'_, C>,
    ) -> Point<C> {
        let adics = at.adics;
        let square = at.half(&adics.add(&at.one(), &point.0));
        let cos = at.power(&square, &Number::rational(1, 2), |field| {
            let f = field.field();
            let (cos, _) = self.known_angle(atom, &Number::integer(1), f, &|id| self.value_in(id, field));
            f.half(&f.add(&f.one(), &cos))
        });
        let sin = adics.mul(&at.half(&point.1), &adics.power(&cos, -1));
        (cos, sin)
    }

    /// The exponential of an argument whose rest is zero.
    fn adic_exponential<C: Coefficient>(
        &self,
        argument: Id,
        values: &Values<C>,
        at: &AdicPoint<'_, C>,
    ) -> Adic<C> {
        let adics = at.adics;
        self.split_in(argument, true, at.lane()).iter().fold(at.one(), |product, (atom, factor)| {
            let power = match atom {
                Atom::Log(base) => self.adic_power(*base, factor, values, at),
                Atom::LogOfPrime(prime) => {
                    let prime = Number::whole(prime.clone());
                    let value = adics.rational(&prime);
                    at.power(&value, factor, |field| field.field().number(&prime))
                }
                _ => {
                    let pi = self.drawn_adic(Id::PI, at);
                    at.power(&pi, factor, |field| self.value_in(Id::PI, field))
                }
            };
            adics.mul(&product, &power)
        })
    }

    /// A sign, a modulus, an extremum or a piecewise function, as it is chosen in a lane.
    fn adic_choice<C: Coefficient>(
        &self,
        function: Function,
        args: &[Id],
        values: &Values<C>,
        at: &AdicPoint<'_, C>,
    ) -> Adic<C> {
        let lane = at.lane();
        let is_positive = |id: Id| self.sign_in(id, lane) == lane.field().one();
        let of_one = |sign: i64| at.adics.integer(&sign.into());
        match function {
            Function::Abs if is_positive(args[0]) => values[&args[0]].clone(),
            Function::Abs => at.adics.mul(&values[&args[0]], &of_one(-1)),
            Function::Sign => of_one(if is_positive(args[0]) { 1 } else { -1 }),
            Function::Min | Function::Max => {
                let in_lane = |id: Id| self.value_in(id, lane);
                values[&self.extremum_in(function, args, in_lane, lane.field())].clone()
            }
            _ => {
                let mut pairs = args[..args.len() - 1].chunks_exact(2);
                let chosen = pairs.find(|pair| is_positive(pair[1]));
                values[&chosen.map_or(args[args.len() - 1], |pair| pair[0])].clone()
            }
        }
    }
}

/// a^2 + b^2, or a^2 - b^2 for the sign -1, where one stands for no node.
struct Square {
    sign: i64,
    of: [Option<Id>; 2],
}

/// Whether a function is found from its argument as an exponential is, or as a sine is; `None` for other functions.
fn of_exponential(function: Function) -> Option<bool> {
    match function {
        Function::Sin | Function::Cos | Function::Tan => Some(false),
        Function::Exp | Function::Sinh | Function::Cosh | Function::Tanh => Some(true),
        _ => None,
    }
}
