//! The order of a tape's instructions, chosen for short live ranges; instructions that no output needs are dropped.
//!
//! The operand whose computation holds more values at the same time comes first [Sethi & Ullman 1970, optimal for
//! trees], and the cosine of an angle follows its sine.

use rustc_hash::FxHashMap;

use crate::graph::Function;
use crate::interrupt::tick;

use super::straight_line::{Instruction, Operand, Tape};

/// The number of values held at the same time while a tree is computed: larger by one if two sides are equal.
pub(super) fn need(operands: impl Iterator<Item = Operand>, needs: &[u32]) -> u32 {
    let of = |operand: Operand| operand.value().map_or(0, |value| needs[value as usize]);
    let join = |x: u32, y: u32| if x == y { x + 1 } else { x.max(y) };
    let mut seen = Vec::new();
    let mut total = None;
    for operand in operands {
        if !seen.contains(&operand) {
            seen.push(operand);
            total = Some(total.map_or(of(operand), |total| join(total, of(operand))));
        }
    }
    total.unwrap_or(0).max(1)
}

/// Reorder the instructions of a tape, and drop those that no output needs.
pub(crate) fn schedule(tape: &Tape, needs: &[u32]) -> Tape {
    let partners = Partners::of(tape);
    let mut order = Order { place: vec![None; tape.instructions.len()], sequence: Vec::new() };
    for output in &tape.outputs {
        order.visit(*output, tape, needs, &partners);
    }
    tape.reordered(&order.sequence)
}

/// The instructions in their new order.
struct Order {
    /// The new place of each instruction that has one.
    place: Vec<Option<u32>>,
    sequence: Vec<u32>,
}

impl Order {
    /// Place everything that an operand needs, and then the operand.
    fn visit(&mut self, root: Operand, tape: &Tape, needs: &[u32], partners: &Partners) {
        let mut stack: Vec<(u32, bool)> = Vec::new();
        stack.extend(root.value().map(|value| (value, false)));
        while let Some((value, ready)) = stack.pop() {
            tick();
            if self.place[value as usize].is_some() {
                continue;
            }
            let instruction = tape.instructions[value as usize];
            if ready {
                self.push(value);
                if let Some(partner) = partners.after(instruction, value) {
                    self.push(partner);
                }
                continue;
            }
            stack.push((value, true));
            let mut operands: Vec<u32> = tape.reads(value as usize).filter_map(Operand::value).collect();
            // The last one pushed is computed first; a stable order where the needs are equal.
            operands.reverse();
            operands.sort_by_key(|&operand| needs[operand as usize]);
            stack.extend(operands.into_iter().map(|operand| (operand, false)));
        }
    }

    fn push(&mut self, value: u32) {
        if self.place[value as usize].is_none() {
            self.place[value as usize] = u32::try_from(self.sequence.len()).ok();
            self.sequence.push(value);
        }
    }
}

/// The needed sines and cosines by argument.
struct Partners {
    by_argument: FxHashMap<Operand, [Option<u32>; 2]>,
}

impl Partners {
    fn of(tape: &Tape) -> Self {
        let mut by_argument: FxHashMap<Operand, [Option<u32>; 2]> = FxHashMap::default();
        let needed = needed(tape);
        for (value, instruction) in (0..).zip(&tape.instructions) {
            match *instruction {
                _ if !needed[value as usize] => {}
                Instruction::Unary(Function::Sin, a) => by_argument.entry(a).or_default()[0] = Some(value),
                Instruction::Unary(Function::Cos, a) => by_argument.entry(a).or_default()[1] = Some(value),
                _ => {}
            }
        }
        Self { by_argument }
    }

    /// The cosine that belongs to a sine, or the sine to a cosine.
    fn after(&self, instruction: Instruction, value: u32) -> Option<u32> {
        let Instruction::Unary(Function::Sin | Function::Cos, argument) = instruction else { return None };
        self.by_argument.get(&argument)?.iter().flatten().copied().find(|&other| other != value)
    }
}

/// Which instructions the outputs need.
fn needed(tape: &Tape) -> Vec<bool> {
    let mut needed = vec![false; tape.instructions.len()];
    for value in tape.outputs.iter().copied().filter_map(Operand::value) {
        needed[value as usize] = true;
    }
    for value in (0..needed.len()).rev() {
        if needed[value] {
            for operand in tape.reads(value).filter_map(Operand::value) {
                needed[operand as usize] = true;
            }
        }
    }
    needed
}
