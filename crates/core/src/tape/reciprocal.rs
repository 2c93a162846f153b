//! Reciprocals: a / d, b / d, ... take one division, 1 / d, and multiplications, which are faster.

use rustc_hash::{FxHashMap, FxHashSet};

use crate::graph::word;

use super::straight_line::{Instruction, Operand, Tape};

impl Tape {
    /// Multiply by the reciprocal of a divisor that several dividends share, or that changes less often than its
    /// dividend.
    ///
    /// The stage of a value says how often it changes.
    pub(super) fn with_reciprocals(&self, stages: impl Fn(Operand) -> u8) -> Self {
        let mut tape = self.clone();
        let one = tape.one();
        let divisors = self.worth_inverting(stages);
        let mut reciprocals = self.reciprocals(one);
        let (mut sequence, mut placed) = (Vec::new(), FxHashSet::default());
        for (place, &instruction) in (0u32..).zip(&self.instructions) {
            if let Instruction::Div(dividend, divisor) = instruction
                && divisors.contains(&divisor)
            {
                let reciprocal = *reciprocals.entry(divisor).or_insert_with(|| {
                    tape.instructions.push(Instruction::Div(one, divisor));
                    word(tape.instructions.len()) - 1
                });
                if placed.insert(reciprocal) {
                    sequence.push(reciprocal);
                }
                if place == reciprocal {
                    continue;
                }
                tape.instructions[place as usize] = Instruction::Mul(dividend, Operand::Value(reciprocal));
            }
            sequence.push(place);
        }
        tape.reordered(&sequence)
    }

    fn one(&mut self) -> Operand {
        let known = self.constants.iter().position(|constant| constant.to_bits() == 1f64.to_bits());
        Operand::Constant(word(known.unwrap_or_else(|| {
            self.constants.push(1.0);
            self.constants.len() - 1
        })))
    }

    /// The reciprocals that the tape already has, by divisor.
    fn reciprocals(&self, one: Operand) -> FxHashMap<Operand, u32> {
        let mut known = FxHashMap::default();
        for (place, &instruction) in (0..).zip(&self.instructions) {
            if let Instruction::Div(dividend, divisor) = instruction
                && dividend == one
            {
                known.insert(divisor, place);
            }
        }
        known
    }

    fn worth_inverting(&self, stages: impl Fn(Operand) -> u8) -> FxHashSet<Operand> {
        let (mut found, mut seen) = (FxHashSet::default(), FxHashSet::default());
        for &instruction in &self.instructions {
            if let Instruction::Div(dividend, divisor) = instruction
                && (!seen.insert(divisor) || stages(divisor) < stages(dividend))
            {
                found.insert(divisor);
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use crate::error::Error;
    use crate::graph::{Assumption, Graph, Id};

    #[test]
    fn dividends_share_the_reciprocal_of_a_divisor() -> Result<(), Error> {
        let g = &mut Graph::new();
        let [a, b, c] = ["a", "b", "c"].map(|name| g.symbol(name, Assumption::Real));
        let sum = g.add(a, b);
        let quotients = [g.div(a, sum)?, g.div(Id::ONE, sum)?, g.div(c, sum)?];
        let cost = g.tape(&[a, b, c], &quotients)?.staged(&[0, 0, 0])?.tape.operations();
        assert_eq!((cost.additions, cost.multiplications, cost.divisions), (1, 2, 1));
        Ok(())
    }

    #[test]
    fn what_changes_seldom_is_inverted_in_its_own_stage() -> Result<(), Error> {
        let g = &mut Graph::new();
        let [a, b] = ["a", "b"].map(|name| g.symbol(name, Assumption::Real));
        let quotient = g.div(a, b)?;
        let staged = g.tape(&[a, b], &[quotient])?.staged(&[1, 0])?;
        assert_eq!(staged.operations().iter().map(|cost| cost.divisions).collect::<Vec<_>>(), [1, 0]);
        let same = g.tape(&[a, b], &[quotient])?.staged(&[1, 1])?;
        assert_eq!(same.operations().iter().map(|cost| cost.divisions).collect::<Vec<_>>(), [0, 1]);
        Ok(())
    }
}
