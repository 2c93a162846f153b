//! The order of a tape's instructions: short live ranges, nothing that no output needs.
//!
//! The operand whose computation holds more values at a time comes first (Sethi & Ullman 1970, exact for
//! trees), and the cosine of an angle follows its sine.

use rustc_hash::FxHashMap;

use crate::function::Function;
use crate::tape::{Instruction, Operand, Tape};

/// The number of values held at a time while a tree is computed: larger where two sides are equal.
pub(crate) fn need(operands: [Operand; 3], needs: &[u32]) -> u32 {
    let [a, b, c] = operands;
    let of = |operand| match operand {
        Operand::Value(value) => needs[value as usize],
        _ => 0,
    };
    let join = |x: u32, y: u32| if x == y { x + 1 } else { x.max(y) };
    let mut total = of(a).max(1);
    if b != a {
        total = join(of(a), of(b));
    }
    if c != a && c != b {
        total = join(total, of(c));
    }
    total
}

/// Reorder the instructions of a tape, and drop those that no output needs.
pub(crate) fn schedule(tape: &Tape, needs: &[u32]) -> Tape {
    let partners = Partners::of(tape);
    let mut order = Order { place: vec![None; tape.instructions.len()], sequence: Vec::new() };
    for output in &tape.outputs {
        order.visit(*output, tape, needs, &partners);
    }
    let mut constants = Constants { place: vec![None; tape.constants.len()], kept: Vec::new() };
    let mut moved = |operand| match operand {
        Operand::Input(_) => operand,
        Operand::Constant(constant) => constants.keep(constant, tape),
        Operand::Value(value) => Operand::Value(order.place[value as usize].unwrap_or(value)),
    };
    let instructions =
        order.sequence.iter().map(|&old| tape.instructions[old as usize].map(&mut moved)).collect();
    let outputs = tape.outputs.iter().map(|&output| moved(output)).collect();
    Tape { inputs: tape.inputs.clone(), constants: constants.kept, instructions, outputs }
}

/// The constants that the code refers to, in the order of their first use.
struct Constants {
    place: Vec<Option<u32>>,
    kept: Vec<f64>,
}

impl Constants {
    fn keep(&mut self, constant: u32, tape: &Tape) -> Operand {
        Operand::Constant(*self.place[constant as usize].get_or_insert_with(|| {
            self.kept.push(tape.constants[constant as usize]);
            self.kept.len() as u32 - 1
        }))
    }
}

/// The instructions in their new order.
struct Order {
    /// The new place of each instruction that has one.
    place: Vec<Option<u32>>,
    sequence: Vec<u32>,
}

impl Order {
    /// Place everything an operand needs, and then the operand.
    fn visit(&mut self, root: Operand, tape: &Tape, needs: &[u32], partners: &Partners) {
        let mut stack: Vec<(u32, bool)> = Vec::new();
        stack.extend(value_of(root).map(|value| (value, false)));
        while let Some((value, ready)) = stack.pop() {
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
            let mut operands = instruction.operands().map(value_of);
            // The last one pushed is computed first; a stable order where the needs are equal.
            operands.reverse();
            operands.sort_by_key(|operand| operand.map(|v| needs[v as usize]));
            stack.extend(operands.into_iter().flatten().map(|operand| (operand, false)));
        }
    }

    fn push(&mut self, value: u32) {
        if self.place[value as usize].is_none() {
            self.place[value as usize] = u32::try_from(self.sequence.len()).ok();
            self.sequence.push(value);
        }
    }
}

const fn value_of(operand: Operand) -> Option<u32> {
    match operand {
        Operand::Value(value) => Some(value),
        _ => None,
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
    for value in tape.outputs.iter().copied().filter_map(value_of) {
        needed[value as usize] = true;
    }
    for value in (0..needed.len()).rev() {
        if needed[value] {
            for operand in tape.instructions[value].operands().into_iter().filter_map(value_of) {
                needed[operand as usize] = true;
            }
        }
    }
    needed
}
