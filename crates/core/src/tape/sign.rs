//! Changes of sign that cost nothing: a subtraction below that is used nowhere else is reversed.

use super::straight_line::{Instruction, Operand, Tape};

/// The most factors that are searched for a subtraction.
const SEARCHED: usize = 64;

/// Replace negations by their arguments where these can be computed with the opposite sign.
///
/// Instructions that become unused stay in the code; the schedule drops them.
pub(super) fn absorb_signs(tape: &mut Tape) {
    let uses = uses(tape);
    for position in 0..tape.instructions.len() {
        if let Instruction::Neg(Operand::Value(value)) = tape.instructions[position]
            && turn_around(tape, &uses, value)
        {
            tape.instructions[position] = tape.instructions[value as usize];
        }
    }
}

/// Change the sign of a value that is used once, by its factors; false if that costs an operation.
fn turn_around(tape: &mut Tape, uses: &[u32], value: u32) -> bool {
    let mut factors = vec![Operand::Value(value)];
    for _ in 0..SEARCHED {
        match factors.pop() {
            Some(Operand::Value(factor)) if uses[factor as usize] == 1 => {
                match tape.instructions[factor as usize] {
                    Instruction::Sub(a, b) => {
                        tape.instructions[factor as usize] = Instruction::Sub(b, a);
                        return true;
                    }
                    Instruction::Mul(a, b) | Instruction::Div(a, b) => factors.extend([b, a]),
                    _ => {}
                }
            }
            Some(_) => {}
            None => return false,
        }
    }
    false
}

/// How often each value is read, outputs included.
pub(crate) fn uses(tape: &Tape) -> Vec<u32> {
    let mut uses = vec![0; tape.instructions.len()];
    let mut count = |operand: Operand| {
        if let Operand::Value(value) = operand {
            uses[value as usize] += 1;
        }
    };
    for position in 0..tape.instructions.len() {
        tape.reads(position).for_each(&mut count);
    }
    tape.outputs.iter().copied().for_each(count);
    uses
}
