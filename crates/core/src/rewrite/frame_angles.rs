//! Waves of multiple angles as products of waves of the angles of frames: `cos(2 x + y) = cos(y) - 2 sin(x) sin(x + y)`.

use crate::error::Error;
use crate::graph::Function;
use crate::polynomial::Polynomial;
use crate::value::Number;

use super::ring::Ring;

/// The most terms of a sum that is rewritten.
const TERMS: usize = 60;

impl Ring<'_> {
    /// A sum linear in waves with products of two waves for each of a double angle. Of the two forms of each, the one
    /// that leaves fewer terms is taken: it cancels a wave of the difference of the angles.
    pub(super) fn in_frame_angles(&mut self, polynomial: &Polynomial) -> Result<Polynomial, Error> {
        let mut result = polynomial.clone();
        if result.len() > TERMS {
            return Ok(result);
        }
        for (monomial, coefficient) in polynomial.iter() {
            let is_wave = |atom: u32| self.wave(atom).is_some();
            let (waves, rest) = monomial.split(is_wave);
            let &[(atom, 1)] = waves.factors() else { continue };
            let Some((shape, argument)) = self.wave(atom) else { continue };
            let angle = self.angle(argument)?;
            let Some([first, second]) = halves(&angle) else { continue };
            let mut without = result.clone();
            without.add_term(monomial.clone(), &coefficient.neg());
            let mut best: Option<Polynomial> = None;
            for form in self.products_of(shape, &first, &second)? {
                self.budget.spend(without.len())?;
                let mut made = without.clone();
                made.add_scaled(&form.shifted(&rest, coefficient), &Number::integer(1));
                if best.as_ref().is_none_or(|known| made.len() < known.len()) {
                    best = Some(made);
                }
            }
            result = best.unwrap_or(result);
        }
        Ok(result)
    }

    /// The wave of a sum of two angles by products of their waves and by the wave of their difference.
    fn products_of(
        &mut self,
        shape: Function,
        first: &Polynomial,
        second: &Polynomial,
    ) -> Result<[Polynomial; 2], Error> {
        let mut difference = first.clone();
        difference.add_scaled(second, &Number::integer(-1));
        let other = self.wave_of(shape, &difference)?;
        let of_sines = if shape == Function::Cos {
            [(Function::Sin, Function::Sin, -2, 1), (Function::Cos, Function::Cos, 2, -1)]
        } else {
            [(Function::Sin, Function::Cos, 2, -1), (Function::Cos, Function::Sin, 2, 1)]
        };
        let mut forms = [Polynomial::default(), Polynomial::default()];
        for (form, (f, g, factor, sign)) in forms.iter_mut().zip(of_sines) {
            let (a, b) = (self.wave_of(f, first)?, self.wave_of(g, second)?);
            *form = self.times(&a, &b)?.scaled(&Number::integer(factor));
            form.add_scaled(&other, &Number::integer(sign));
        }
        Ok(forms)
    }
}

/// An angle with simple and double terms as the sum of all of them, once, and of the double ones.
fn halves(angle: &Polynomial) -> Option<[Polynomial; 2]> {
    let (mut all, mut double) = (Polynomial::default(), Polynomial::default());
    for (monomial, coefficient) in angle.iter() {
        let times = coefficient.to_i64().filter(|n| (1..=2).contains(&n.abs()) && !monomial.is_one())?;
        all.add_term(monomial.clone(), &Number::integer(times.signum()));
        if times.abs() == 2 {
            double.add_term(monomial.clone(), &Number::integer(times.signum()));
        }
    }
    (double.len() > 0).then_some([all, double])
}
