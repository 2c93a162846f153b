//! Shared coefficients: the products c (a b), c (a d), ... share the product c a.

use rustc_hash::{FxHashMap, FxHashSet};

use crate::graph::word;

use super::sign::uses;
use super::straight_line::{Instruction, Operand, Tape};

/// A constant and the factor that it multiplies.
type Pair = (Operand, Operand);

/// A constant times a product that nothing else reads.
struct Multiple {
    constant: Operand,
    product: u32,
    factors: [Operand; 2],
}

impl Tape {
    /// Multiply the factor that several products share by their constant, instead of each product.
    pub(super) fn with_shared_coefficients(&self) -> Self {
        let mut tape = self.clone();
        let multiples = self.multiples();
        let shared = self.shared_pairs(&multiples);
        let mut known = self.known_pairs();
        let dropped: FxHashSet<u32> = multiples
            .values()
            .filter(|multiple| shared.contains_key(&multiple.product))
            .map(|multiple| multiple.product)
            .collect();
        let (mut sequence, mut placed) = (Vec::new(), FxHashSet::default());
        for place in 0..word(self.instructions.len()) {
            if dropped.contains(&place) || !placed.insert(place) {
                continue;
            }
            if let Some(multiple) = multiples.get(&place)
                && let Some(&(factor, other)) = shared.get(&multiple.product)
            {
                let coefficient = *known.entry((multiple.constant, factor)).or_insert_with(|| {
                    tape.instructions.push(Instruction::Mul(multiple.constant, factor));
                    word(tape.instructions.len()) - 1
                });
                if placed.insert(coefficient) {
                    sequence.push(coefficient);
                }
                tape.instructions[place as usize] = Instruction::Mul(Operand::Value(coefficient), other);
            }
            sequence.push(place);
        }
        tape.reordered(&sequence)
    }

    /// The values that are a constant times a product, by their place.
    fn multiples(&self) -> FxHashMap<u32, Multiple> {
        let uses = uses(self);
        let mut found = FxHashMap::default();
        for (place, &instruction) in (0..).zip(&self.instructions) {
            if let Instruction::Mul(constant @ Operand::Constant(_), Operand::Value(product))
            | Instruction::Mul(Operand::Value(product), constant @ Operand::Constant(_)) = instruction
                && uses[product as usize] == 1
                && let Instruction::Mul(a, b) = self.instructions[product as usize]
                && ![a, b].iter().any(|factor| matches!(factor, Operand::Constant(_)))
            {
                found.insert(place, Multiple { constant, product, factors: [a, b] });
            }
        }
        found
    }

    /// For each product: the factor that takes the constant, as it does in other products, and the other factor.
    fn shared_pairs(&self, multiples: &FxHashMap<u32, Multiple>) -> FxHashMap<u32, Pair> {
        let places = || (0..word(self.instructions.len())).filter_map(|place| multiples.get(&place));
        let mut counts: FxHashMap<Pair, u32> = FxHashMap::default();
        for pair in places().flat_map(|m| m.factors.map(|factor| (m.constant, factor))) {
            *counts.entry(pair).or_default() += 1;
        }
        let known = self.known_pairs();
        let worth = |pair: &Pair| counts[pair] + u32::from(known.contains_key(pair));
        let chosen: Vec<(u32, Pair, Operand)> = places()
            .map(|Multiple { constant, product, factors: [a, b] }| {
                let first = worth(&(*constant, *a)) >= worth(&(*constant, *b));
                let (factor, other) = if first { (*a, *b) } else { (*b, *a) };
                (*product, (*constant, factor), other)
            })
            .collect();
        let mut takers: FxHashMap<Pair, u32> = FxHashMap::default();
        for (_, pair, _) in &chosen {
            *takers.entry(*pair).or_default() += 1;
        }
        let pays = |pair: &Pair| takers[pair] + u32::from(known.contains_key(pair)) > 1;
        let pairs = chosen.into_iter().filter(|(_, pair, _)| pays(pair));
        pairs.map(|(product, (_, factor), other)| (product, (factor, other))).collect()
    }

    /// The multiples of single factors that the tape already has.
    fn known_pairs(&self) -> FxHashMap<Pair, u32> {
        let mut known = FxHashMap::default();
        for (place, &instruction) in (0..).zip(&self.instructions) {
            match instruction {
                Instruction::Mul(constant @ Operand::Constant(_), factor)
                | Instruction::Mul(factor, constant @ Operand::Constant(_)) => {
                    known.insert((constant, factor), place);
                }
                _ => {}
            }
        }
        known
    }
}

#[cfg(test)]
mod tests {
    use crate::error::Error;
    use crate::graph::{Assumption, Graph};
    use crate::value::Number;

    #[test]
    fn products_share_a_multiple_of_a_factor() -> Result<(), Error> {
        let g = &mut Graph::new();
        let [a, b, c, d] = ["a", "b", "c", "d"].map(|name| g.symbol(name, Assumption::Real));
        let three = g.number_id(&Number::integer(3));
        let mut outputs = Vec::new();
        for other in [b, c, d] {
            let product = g.mul(a, other)?;
            outputs.push(g.scale(three, product));
        }
        let tape = g.tape(&[a, b, c, d], &outputs)?;
        assert_eq!(tape.operations().multiplications, 6);
        assert_eq!(tape.with_shared_coefficients().operations().multiplications, 4);
        let point = [2.0, 3.0, 5.0, 7.0];
        let values = |tape| crate::tape::eval::Evaluator::new(tape).evaluate(&point);
        assert_eq!(values(&tape.with_shared_coefficients()), values(&tape));
        Ok(())
    }
}
