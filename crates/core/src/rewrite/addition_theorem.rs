//! Sines, cosines and tangents of sums and multiples, circular and hyperbolic, expressed by those of single angles.

use num_integer::Integer;
use rustc_hash::FxHashMap;

use crate::error::Error;
use crate::graph::{Function, Id};
use crate::polynomial::{Monomial, Polynomial};
use crate::value::Number;

use super::ring::{Ring, single_power};

/// An even and an odd function with an addition theorem, and their quotient.
///
/// With the sign s: `even(a + b) = even(a) even(b) + s odd(a) odd(b)` and `odd(a + b) = odd(a) even(b) + even(a) odd(b)`.
/// The theorem of the quotient is these two, with 1 for the even function and the quotient for the odd one.
#[derive(Clone, Copy)]
pub(super) struct Waves {
    even: Function,
    odd: Function,
    quotient: Function,
    sign: i64,
}

const WAVES: [Waves; 2] = [
    Waves { even: Function::Cos, odd: Function::Sin, quotient: Function::Tan, sign: -1 },
    Waves { even: Function::Cosh, odd: Function::Sinh, quotient: Function::Tanh, sign: 1 },
];

/// The place of the circular functions in the table.
pub(super) const CIRCULAR: usize = 0;

/// Which of the [`WAVES`] a function belongs to.
pub(super) fn waves_of(function: Function) -> Option<usize> {
    WAVES.iter().position(|waves| [waves.even, waves.odd, waves.quotient].contains(&function))
}

/// Angles that are larger multiples of their unit stay closed, unless a user requests the expansion.
const LARGEST_MULTIPLE: i64 = 8;

/// The atom of the imaginary unit: a number that no atom of an expression has.
const IMAGINARY_UNIT: u32 = u32::MAX;

/// Update, for each atomic angle, the greatest common divisor of its multiples by those in one more angle. If all is
/// opened, integer multiples are those of the angle itself, such as 2 and 2.0.
pub(super) fn update_units(units: &mut FxHashMap<Monomial, Number>, angle: &Polynomial, opens_all: bool) {
    let one = Number::integer(1);
    for (monomial, coefficient) in angle.iter() {
        let is_multiple = coefficient.is_integer() && !monomial.is_one();
        let coefficient = if opens_all && is_multiple { &one } else { coefficient };
        let unit = match units.get(monomial) {
            Some(known) => common_unit(known, coefficient),
            None => coefficient.abs(),
        };
        units.insert(monomial.clone(), unit);
    }
}

impl Ring<'_> {
    /// A wave of a sum of multiples of units, by the addition theorems. Each atomic angle has its unit.
    pub(super) fn expand_wave(
        &mut self,
        id: Id,
        shape: Function,
        angle: &Polynomial,
        units: &FxHashMap<Monomial, Number>,
    ) -> Result<Polynomial, Error> {
        let Some(waves) = waves_of(shape).map(|place| WAVES[place]) else { return Ok(self.leaf(id)) };
        let mut multiples = Vec::new();
        for (monomial, coefficient) in angle.iter() {
            let Some((unit, n)) = self.multiple_of_unit(coefficient, &units[monomial])? else {
                return Ok(self.leaf(id));
            };
            multiples.push((Polynomial::term(monomial.clone(), unit), n));
        }
        let by_quotients = self.opens_all && shape == waves.quotient;
        let mut even = Polynomial::constant(Number::integer(1));
        let mut odd = Polynomial::default();
        for (angle, n) in multiples {
            let (c, s) = if by_quotients {
                let Some(quotient) = self.quotient_of(waves, &angle)? else { return Ok(self.leaf(id)) };
                (Polynomial::constant(Number::integer(1)), quotient)
            } else {
                (self.wave_of(waves.even, &angle)?, self.wave_of(waves.odd, &angle)?)
            };
            let s = s.scaled(&Number::integer(n.signum()));
            if n.abs() > LARGEST_MULTIPLE
                && let Some((c, s)) = self.multiple(waves, (&c, &s), n.unsigned_abs())?
            {
                (even, odd) = self.rotate(waves, (&even, &odd), (&c, &s))?;
                continue;
            }
            for _ in 0..n.abs() {
                (even, odd) = self.rotate(waves, (&even, &odd), (&c, &s))?;
            }
        }
        if shape == waves.odd {
            return Ok(odd);
        }
        if shape == waves.even {
            return Ok(even);
        }
        if by_quotients {
            (even, odd) = (self.one_term(&even)?, self.one_term(&odd)?);
        }
        if even.single().is_none() {
            return Ok(self.leaf(id));
        }
        let (monomial, factor) = single_power(&even, -1)?;
        Ok(odd.shifted(&monomial, &factor))
    }

    /// The unit and the integer of which a coefficient is the product; `None` if its wave stays closed.
    ///
    /// Decimals have a common unit such as 0.01 by chance. What would be a large multiple of it is a unit of its own.
    fn multiple_of_unit(&self, coefficient: &Number, unit: &Number) -> Result<Option<(Number, i64)>, Error> {
        let multiple = coefficient.mul(&unit.recip()?).to_i64();
        let is_large = multiple.is_none_or(|n| n.abs() > LARGEST_MULTIPLE);
        let is_fraction = coefficient.is_decimal() && !coefficient.is_integer();
        Ok(match multiple {
            _ if coefficient.is_decimal() && !self.opens_all => None,
            _ if is_fraction && is_large => {
                Some((coefficient.abs(), if coefficient.is_negative() { -1 } else { 1 }))
            }
            Some(n) if !is_large || self.opens_all => Some((unit.clone(), n)),
            _ => None,
        })
    }

    /// A sum as a multiple of one atom, with integer coefficients under it if its own are rational.
    fn one_term(&mut self, sum: &Polynomial) -> Result<Polynomial, Error> {
        if sum.len() < 2 {
            return Ok(sum.clone());
        }
        let content = sum.numeric_content();
        let node = self.node_of(&sum.clone().scaled(&content.recip()?))?;
        Ok(self.leaf(node).scaled(&content))
    }

    /// The tangent of an angle; `None` at a pole.
    fn quotient_of(&mut self, waves: Waves, angle: &Polynomial) -> Result<Option<Polynomial>, Error> {
        let is_pole = angle.single().is_some() && self.wave_of(waves.even, angle)?.len() == 0;
        if is_pole { Ok(None) } else { self.wave_of(waves.quotient, angle).map(Some) }
    }

    /// The even and the odd wave of n times an angle: the parts of `(even + i odd)**n` [de Moivre], where the square of i is
    /// the sign of the theorem; `None` if those of the angle are no atoms.
    fn multiple(
        &mut self,
        waves: Waves,
        (c, s): (&Polynomial, &Polynomial),
        n: u64,
    ) -> Result<Option<(Polynomial, Polynomial)>, Error> {
        let (Some(_), Some(_)) = (c.single(), s.single()) else { return Ok(None) };
        let one = Number::integer(1);
        let mut both = s.shifted(&Monomial::power(IMAGINARY_UNIT, 1), &one);
        both.add_scaled(c, &one);
        let (mut even, mut odd) = (Polynomial::default(), Polynomial::default());
        for (monomial, coefficient) in self.power(&both, n)?.iter() {
            let (turns, rest) = monomial.split(|atom| atom == IMAGINARY_UNIT);
            let quarter = turns.degree() % 4;
            let part = if quarter % 2 == 0 { &mut even } else { &mut odd };
            let sign = if quarter > 1 { waves.sign } else { 1 };
            part.add_term(rest, &coefficient.mul(&Number::integer(sign)));
        }
        Ok(Some((even, odd)))
    }

    /// The even and the odd wave of the sum of two angles.
    fn rotate(
        &mut self,
        waves: Waves,
        (c1, s1): (&Polynomial, &Polynomial),
        (c2, s2): (&Polynomial, &Polynomial),
    ) -> Result<(Polynomial, Polynomial), Error> {
        let mut even = self.times(c1, c2)?;
        even.add_scaled(&self.times(s1, s2)?, &Number::integer(waves.sign));
        let mut odd = self.times(s1, c2)?;
        odd.add_scaled(&self.times(c1, s2)?, &Number::integer(1));
        Ok((even, odd))
    }
}

/// The largest number of which both are integer multiples: a decimal, unless both are exact or it is an integer.
fn common_unit(a: &Number, b: &Number) -> Number {
    let num = (a.numerator() * b.denominator()).gcd(&(b.numerator() * a.denominator()));
    let unit = Number::from_big(num, a.denominator() * b.denominator()).expect("denominators are positive");
    let is_decimal = !unit.is_integer() && (a.is_decimal() || b.is_decimal());
    unit.with_decimal(is_decimal)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::{Assumption, Graph, NumberId, View};

    #[test]
    fn a_request_opens_integer_multiples() -> Result<(), Error> {
        let g = &mut Graph::new();
        let a = g.symbol("a", Assumption::Real);
        let two = g.number_id(&Number::integer(2));
        let double = g.scale(two, a);
        let sine = g.apply(Function::Sin, &[double])?;
        let expanded = g.expand_trig(sine)?;
        assert_eq!(g.to_text(expanded), "2*sin(a)*cos(a)");
        for n in [-3, 9, 40, 401] {
            let factor = g.number_id(&Number::integer(n));
            let angle = g.scale(factor, a);
            for shape in [Function::Sin, Function::Cos] {
                let wave = g.apply(shape, &[angle])?;
                let expanded = g.expand_trig(wave)?;
                assert!(g.equal(wave, expanded));
                for node in g.post_order(&[expanded]) {
                    assert!(!matches!(g.view(node), View::Function(_, args) if args.get(0) != a));
                }
            }
        }
        Ok(())
    }

    #[test]
    fn angles_with_decimals_open() -> Result<(), Error> {
        let g = &mut Graph::new();
        let [a, b] = ["a", "b"].map(|name| g.symbol(name, Assumption::Real));
        let mut wave = |terms: &[(f64, Id)]| -> Result<(Id, Id), Error> {
            let mut angle = Id::ZERO;
            for &(factor, node) in terms {
                let factor = g.number_id(&Number::from_f64(factor)?);
                let term = g.scale(factor, node);
                angle = g.add(angle, term);
            }
            let sine = g.apply(Function::Sin, &[angle])?;
            let expanded = g.expand_trig(sine)?;
            assert!(g.equal(sine, expanded));
            Ok((sine, expanded))
        };
        let sums = [wave(&[(2.0, a)])?, wave(&[(0.5, a), (1.0, b)])?, wave(&[(0.37, a), (-0.92, b)])?];
        let (_, alone) = wave(&[(0.37, a)])?;
        let texts = sums.map(|(sine, expanded)| (g.to_text(expanded), sine != expanded));
        assert_eq!(texts[0], ("2*sin(a)*cos(a)".to_owned(), true));
        assert!(texts.iter().all(|(_, is_opened)| *is_opened), "{texts:?}");
        assert_eq!(g.to_text(alone), "sin(0.37*a)");
        Ok(())
    }

    #[test]
    fn angles_open_to_their_common_unit() -> Result<(), Error> {
        let g = &mut Graph::new();
        let [a, b] = ["a", "b"].map(|name| g.symbol(name, Assumption::Real));
        let (half, three) = (g.number_id(&Number::rational(1, 2)), g.number_id(&Number::integer(3)));
        let angle = g.sum(&[(half, a), (NumberId::MINUS_ONE, b)]);
        let cosine = g.apply(Function::Cos, &[angle])?;
        let multiple = g.scale(three, a);
        let sine = g.apply(Function::Sin, &[multiple])?;
        let sum = g.add(cosine, sine);
        let expanded = g.expand_trig(sum)?;
        assert!(g.equal(sum, expanded));
        let unit = g.scale(half, a);
        for node in g.post_order(&[expanded]) {
            if let View::Function(_, args) = g.view(node) {
                assert!(args.get(0) == unit || args.get(0) == b);
            }
        }
        Ok(())
    }
}
