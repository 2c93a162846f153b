//! Stages: instructions sorted by how often their inputs change.
//!
//! Parameters change rarely, accelerations at every call: the first instructions of the code can leave the hot path.

use crate::error::Error;
use crate::graph::{Cost, word};

use super::straight_line::{Operand, Tape};

/// A tape whose instructions are sorted by stage.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Staged {
    /// The code; within a stage in the order of the schedule.
    pub tape: Tape,
    /// The stage of each instruction: the highest stage among its operands.
    pub stages: Vec<u8>,
}

impl Tape {
    /// Sort the instructions by stage, given the stage of each input.
    ///
    /// If stages are given, the code is for many calls: products share coefficients, and divisions become products with
    /// reciprocals.
    ///
    /// # Errors
    /// If stages are given, but not one for each input.
    pub fn staged(&self, inputs: &[u8]) -> Result<Staged, Error> {
        if inputs.is_empty() {
            return Ok(Staged { tape: self.clone(), stages: vec![0; self.instructions.len()] });
        }
        if inputs.len() != self.inputs.len() {
            let (left, right) = ((inputs.len(), 1), (self.inputs.len(), 1));
            return Err(Error::Shape { operation: "staging", left, right });
        }
        let tape = self.with_shared_coefficients();
        let stages = tape.stages(inputs);
        let tape = tape.with_reciprocals(|operand| stage_of(operand, inputs, &stages));
        let mut stages = tape.stages(inputs);
        let mut sequence: Vec<u32> = (0..word(tape.instructions.len())).collect();
        sequence.sort_by_key(|&value| stages[value as usize]);
        stages.sort_unstable();
        Ok(Staged { tape: tape.reordered(&sequence), stages })
    }

    /// The stage of each instruction.
    fn stages(&self, inputs: &[u8]) -> Vec<u8> {
        let mut stages: Vec<u8> = Vec::with_capacity(self.instructions.len());
        for position in 0..self.instructions.len() {
            let stage = self.reads(position).map(|operand| stage_of(operand, inputs, &stages)).max();
            stages.push(stage.unwrap_or(0));
        }
        stages
    }
}

fn stage_of(operand: Operand, inputs: &[u8], values: &[u8]) -> u8 {
    match operand {
        Operand::Constant(_) => 0,
        Operand::Input(input) => inputs[input as usize],
        Operand::Value(value) => values[value as usize],
    }
}

impl Staged {
    /// The operations of each stage up to the last one that has any.
    #[must_use]
    pub fn operations(&self) -> Vec<Cost> {
        let count = self.stages.last().map_or(0, |&stage| usize::from(stage) + 1);
        let mut costs = vec![Cost::default(); count];
        for (position, &stage) in self.stages.iter().enumerate() {
            costs[usize::from(stage)] += self.tape.cost_of(position);
        }
        costs
    }
}
