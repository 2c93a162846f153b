//! Sines, cosines and tangents of sums and multiples, expressed by those of single angles.

use num_integer::Integer;
use rustc_hash::FxHashMap;

use crate::error::Error;
use crate::graph::{Function, Id};
use crate::polynomial::{Monomial, Polynomial};
use crate::value::Number;

use super::ring::{Ring, single_power};

/// Angles that are larger multiples of their unit stay closed, unless a user requests the expansion.
const LARGEST_MULTIPLE: i64 = 8;

/// The atom of the imaginary unit: a number that no atom of an expression has.
const IMAGINARY_UNIT: u32 = u32::MAX;

/// Update, for each atomic angle, the greatest common divisor of its multiples by those in one more angle. If all is
/// opened, integer multiples are those of the angle itself.
pub(super) fn update_units(units: &mut FxHashMap<Monomial, Number>, angle: &Polynomial, opens_all: bool) {
    let one = Number::integer(1);
    for (monomial, coefficient) in angle.iter() {
        let is_multiple = coefficient.is_integer() && !coefficient.is_decimal() && !monomial.is_one();
        let coefficient = if opens_all && is_multiple { &one } else { coefficient };
        let unit = match units.get(monomial) {
            Some(known) => common_unit(known, coefficient),
            None => coefficient.abs(),
        };
        units.insert(monomial.clone(), unit);
    }
}

impl Ring<'_> {
    /// sin, cos or tan of a sum of multiples of units, by the addition theorems. Each atomic angle has its unit.
    pub(super) fn expand_wave(
        &mut self,
        id: Id,
        shape: Function,
        angle: &Polynomial,
        units: &FxHashMap<Monomial, Number>,
    ) -> Result<Polynomial, Error> {
        let mut multiples = Vec::new();
        for (monomial, coefficient) in angle.iter() {
            let unit = units[monomial].clone();
            let Some(n) = coefficient.mul(&unit.recip()?).to_i64() else { return Ok(self.leaf(id)) };
            if (n.abs() > LARGEST_MULTIPLE && !self.opens_all) || coefficient.is_decimal() {
                return Ok(self.leaf(id));
            }
            multiples.push((Polynomial::term(monomial.clone(), unit), n));
        }
        let mut cos = Polynomial::constant(Number::integer(1));
        let mut sin = Polynomial::default();
        for (angle, n) in multiples {
            let c = self.wave_of(Function::Cos, &angle)?;
            let s = self.wave_of(Function::Sin, &angle)?.scaled(&Number::integer(n.signum()));
            if n.abs() > LARGEST_MULTIPLE
                && let Some((c, s)) = self.multiple((&c, &s), n.unsigned_abs())?
            {
                (cos, sin) = self.rotate((&cos, &sin), (&c, &s))?;
                continue;
            }
            for _ in 0..n.abs() {
                (cos, sin) = self.rotate((&cos, &sin), (&c, &s))?;
            }
        }
        match (shape, cos.single().is_some()) {
            (Function::Sin, _) => Ok(sin),
            (Function::Cos, _) => Ok(cos),
            (_, false) => Ok(self.leaf(id)),
            (_, true) => {
                let (monomial, factor) = single_power(&cos, -1)?;
                Ok(sin.shifted(&monomial, &factor))
            }
        }
    }

    /// The cosine and the sine of n times an angle: the parts of `(cos + i sin)**n` [de Moivre]; `None` if those of the
    /// angle are no atoms.
    fn multiple(
        &mut self,
        (c, s): (&Polynomial, &Polynomial),
        n: u64,
    ) -> Result<Option<(Polynomial, Polynomial)>, Error> {
        let (Some(_), Some(_)) = (c.single(), s.single()) else { return Ok(None) };
        let one = Number::integer(1);
        let mut both = s.shifted(&Monomial::power(IMAGINARY_UNIT, 1), &one);
        both.add_scaled(c, &one);
        let (mut cos, mut sin) = (Polynomial::default(), Polynomial::default());
        for (monomial, coefficient) in self.power(&both, n)?.iter() {
            let (turns, rest) = monomial.split(|atom| atom == IMAGINARY_UNIT);
            let quarter = turns.degree() % 4;
            let part = if quarter % 2 == 0 { &mut cos } else { &mut sin };
            part.add_term(rest, &if quarter > 1 { coefficient.neg() } else { coefficient.clone() });
        }
        Ok(Some((cos, sin)))
    }

    /// The cosine and the sine of the sum of two angles.
    fn rotate(
        &mut self,
        (c1, s1): (&Polynomial, &Polynomial),
        (c2, s2): (&Polynomial, &Polynomial),
    ) -> Result<(Polynomial, Polynomial), Error> {
        let mut cos = self.times(c1, c2)?;
        cos.add_scaled(&self.times(s1, s2)?, &Number::integer(-1));
        let mut sin = self.times(s1, c2)?;
        sin.add_scaled(&self.times(c1, s2)?, &Number::integer(1));
        Ok((cos, sin))
    }
}

/// The largest number of which both are integer multiples.
fn common_unit(a: &Number, b: &Number) -> Number {
    let num = (a.numerator() * b.denominator()).gcd(&(b.numerator() * a.denominator()));
    Number::from_big(num, a.denominator() * b.denominator()).expect("denominators are positive")
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
