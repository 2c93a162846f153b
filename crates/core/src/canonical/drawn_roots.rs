//! Products of roots that lanes draw: what is known of them by form.
//!
//! For principal powers, u**r u**s = u**(r + s), (u**r v**s)**n = u**(r n) v**(s n) for an integer n, and (c u)**r = c**r u**r
//! for a positive number c. The lanes know these laws by value, except for roots that they draw.

use crate::graph::{Graph, Id};
use crate::value::Number;

use super::collector::Collector;

impl Graph {
    /// Open the products of drawn roots that have an exponent, or a base in common with another one.
    pub(super) fn merge_drawn_roots(&mut self, out: &mut Collector) {
        let drawn: Vec<Option<Vec<(Id, Number)>>> =
            out.factors.iter().map(|(root, n)| self.powers_of_drawn_roots(*root, n)).collect();
        if drawn.iter().all(Option::is_none) {
            return;
        }
        for (place, (root, exponent)) in std::mem::take(&mut out.factors).into_iter().enumerate() {
            match &drawn[place] {
                Some(powers) if !exponent.is_one() || self.shares_a_base(powers, place, &drawn) => {
                    for (base, power) in powers {
                        self.push_power_of_multiple(out, *base, power);
                    }
                }
                _ => out.push(self, root, &exponent),
            }
        }
    }

    fn shares_a_base(
        &mut self,
        powers: &[(Id, Number)],
        place: usize,
        all: &[Option<Vec<(Id, Number)>>],
    ) -> bool {
        let others = all
            .iter()
            .enumerate()
            .filter(|&(k, _)| k != place)
            .flat_map(|(_, powers)| powers.iter().flatten());
        let bases: Vec<Id> =
            others.map(|&(base, _)| base).filter(|&base| self.as_number(base).is_none()).collect();
        powers.iter().any(|&(base, _)| bases.iter().any(|&other| self.positive_ratio(base, other).is_some()))
    }

    /// Multiply by a power of a base, which may be a multiple of one that is present.
    fn push_power_of_multiple(&mut self, out: &mut Collector, base: Id, power: &Number) {
        if let Some(number) = self.as_number(base) {
            return out.push_power_of_number(number, power);
        }
        let present: Vec<Id> = out.factors.iter().map(|&(known, _)| known).collect();
        let multiple = present.into_iter().find_map(|known| Some((known, self.positive_ratio(base, known)?)));
        let (base, ratio) = multiple.unwrap_or((base, Number::integer(1)));
        out.push_power_of_number(&ratio, power);
        out.push(self, base, power);
    }

    /// The positive number by which a node is a multiple of another one.
    fn positive_ratio(&mut self, node: Id, of: Id) -> Option<Number> {
        let ratio = (self.value(node) * self.value(of).inverse()).to_simple_rational()?;
        if ratio.is_negative() || ratio.is_zero() {
            return None;
        }
        let number = self.number_id(&ratio);
        let multiple = self.scale(number, of);
        self.same(multiple, node).then_some(ratio)
    }
}
