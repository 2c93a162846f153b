//! The shortest of a few forms of a polynomial in sines and cosines, for each factor that they share.

use crate::error::Error;
use crate::polynomial::Polynomial;
use crate::value::Number;

use super::collect::grouped;
use super::ring::Ring;

/// The criteria of length: terms first, then factors and coefficients.
type Length = (usize, u64);

fn length(polynomial: &Polynomial) -> Length {
    let of_term = |c: &Number| u64::from(!c.abs().is_one());
    (polynomial.len(), polynomial.iter().map(|(m, c)| m.degree() + of_term(c)).sum())
}

impl Ring<'_> {
    /// The identities that leave fewer terms.
    pub(super) fn shortened(&mut self, polynomial: &Polynomial) -> Result<Polynomial, Error> {
        let short = self.shorten(polynomial)?;
        let joined = self.join_angles(&short)?;
        self.shorten(&joined)
    }

    /// For each product of other atoms, the shortest form of the sines and cosines that multiply it.
    pub(super) fn shortest_trig(&mut self, polynomial: &Polynomial) -> Result<Polynomial, Error> {
        let groups = grouped(polynomial, |atom| self.wave(atom).is_none());
        let mut known: Vec<(Polynomial, Polynomial)> = Vec::new();
        let mut result = Polynomial::default();
        for (monomial, waves) in groups {
            let (_, factor) = waves.iter().next_back().expect("a group has a term");
            let factor = factor.clone();
            let waves = waves.scaled(&factor.recip()?);
            let short = match known.iter().find(|(long, _)| *long == waves) {
                Some((_, short)) => short.clone(),
                None => self.shortest_waves(&waves)?,
            };
            result.add_scaled(&short.shifted(&monomial, &factor), &Number::integer(1));
            known.push((waves, short));
        }
        Ok(result)
    }

    fn shortest_waves(&mut self, waves: &Polynomial) -> Result<Polynomial, Error> {
        let no_sines = self.eliminate_all(waves, |(sin, cos)| (sin, cos))?;
        let no_cosines = self.eliminate_all(waves, |(sin, cos)| (cos, sin))?;
        let mut best = self.shortened(waves)?;
        for start in [&no_sines, &no_cosines] {
            let form = self.shortened(start)?;
            replace_if_shorter(&mut best, form);
        }
        self.descend(&mut best)?;
        let combined = self.combined(waves)?;
        replace_if_shorter(&mut best, combined);
        Ok(best)
    }

    /// Eliminate the square of one sine or cosine at a time while that helps.
    fn descend(&mut self, best: &mut Polynomial) -> Result<(), Error> {
        for (sin, cos) in self.angles_in(best)? {
            for (from, to) in [(sin, cos), (cos, sin)] {
                let form = self.eliminate(best, from, to)?;
                let form = self.shortened(&form)?;
                replace_if_shorter(best, form);
            }
        }
        Ok(())
    }
}

fn replace_if_shorter(best: &mut Polynomial, form: Polynomial) {
    if length(&form) < length(best) {
        *best = form;
    }
}
