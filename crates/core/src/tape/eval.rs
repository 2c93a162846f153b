//! Evaluation of a tape in doubles: at one point, or at many points, a chunk at a time.

use std::collections::BTreeSet;

use crate::error::Error;
use crate::kernel::Deficiency;

use super::linear_systems::{LinearSystems, Memory, solution_of};
use super::straight_line::{Instruction, Operand, Tape};

/// Bytes of registers in a chunk of points, so that they fit into the cache of the processor.
const CHUNK_BYTES: usize = 256 * 1024;
const MOST_LANES: usize = 256;
const FEWEST_LANES: usize = 16;

/// A tape prepared for evaluation: everything is in numbered slots, first constants, then inputs, then registers.
#[derive(Clone, Debug)]
pub struct Evaluator {
    inputs: Vec<String>,
    constants: Vec<f64>,
    steps: Vec<Step>,
    /// Outputs in the order of the steps that compute them; outputs that need no step come first.
    stores: Vec<Store>,
    outputs: usize,
    registers: usize,
    systems: LinearSystems,
}

/// An instruction over slots, and the slot of its result; a component names the number of its solution.
#[derive(Clone, Copy, Debug)]
struct Step {
    instruction: Instruction<u32>,
    target: u32,
}

/// An output, and the slot that holds it after the given number of steps.
#[derive(Clone, Copy, Debug)]
struct Store {
    steps: usize,
    slot: u32,
    output: usize,
}

/// The values of one input.
#[derive(Clone, Copy, Debug)]
pub enum Column<'a> {
    /// One value for all points.
    Scalar(f64),
    /// A value for each point.
    Array(&'a [f64]),
}

impl Evaluator {
    /// Prepare a tape for evaluation.
    #[must_use]
    pub fn new(tape: &Tape) -> Self {
        let registers = tape.registers();
        let (first_input, first_register) = tape.first_places();
        let slot = |operand| match operand {
            Operand::Constant(constant) => constant,
            Operand::Input(input) => first_input + input,
            Operand::Value(value) => first_register + registers.of[value as usize],
        };
        let step = |(instruction, register): (&Instruction, &u32)| Step {
            instruction: match *instruction {
                Instruction::Component(solution, index) => {
                    Instruction::Component(solution_of(tape, solution), index)
                }
                other => other.map(slot),
            },
            target: first_register + register,
        };
        let store = |(output, &operand): (usize, &Operand)| {
            let steps = if let Operand::Value(value) = operand { value as usize + 1 } else { 0 };
            Store { steps, slot: slot(operand), output }
        };
        let mut stores: Vec<Store> = tape.outputs.iter().enumerate().map(store).collect();
        stores.sort_by_key(|store| store.steps);
        Self {
            inputs: tape.inputs.clone(),
            constants: tape.constants.clone(),
            steps: tape.instructions.iter().zip(&registers.of).map(step).collect(),
            stores,
            outputs: tape.outputs.len(),
            registers: registers.count,
            systems: LinearSystems::new(tape, slot),
        }
    }

    /// The number of outputs.
    #[must_use]
    pub const fn outputs(&self) -> usize {
        self.outputs
    }

    /// The outputs at one point.
    ///
    /// # Errors
    /// If there are too few or too many inputs.
    pub fn evaluate(&self, inputs: &[f64]) -> Result<Vec<f64>, Error> {
        Ok(self.evaluate_noting(inputs)?.0)
    }

    /// The outputs at one point, and the linear systems of deficient rank there.
    ///
    /// # Errors
    /// If there are too few or too many inputs.
    pub fn evaluate_noting(&self, inputs: &[f64]) -> Result<(Vec<f64>, BTreeSet<Deficiency>), Error> {
        self.check(inputs.len())?;
        let mut out = vec![0.0; self.outputs];
        let mut slots = [&self.constants, inputs].concat();
        slots.resize(slots.len() + self.registers, 0.0);
        let mut memory = self.systems.memory(1);
        let mut done = 0;
        for store in &self.stores {
            for step in &self.steps[done..store.steps] {
                slots[step.target as usize] = self.run(step.instruction, &slots, &mut memory);
            }
            done = store.steps;
            out[store.output] = slots[store.slot as usize];
        }
        Ok((out, memory.deficiencies))
    }

    /// One instruction at one point.
    fn run(&self, instruction: Instruction<u32>, slots: &[f64], memory: &mut Memory) -> f64 {
        let read = |slot: u32, _: usize| slots[slot as usize];
        match instruction {
            Instruction::Factor(number) => self.systems.factor(number, 1, memory, read),
            Instruction::Solve(number) => self.systems.solve(number, 1, memory, read),
            Instruction::Component(number, index) => return self.systems.component(number, index, 0, memory),
            _ => return instruction.evaluate(|slot| slots[slot as usize]),
        }
        0.0
    }

    /// The outputs at many points: all points of the first output, then all of the second, and so on.
    ///
    /// # Errors
    /// If there are too few or too many inputs, or the length of an array is not `points`.
    pub fn evaluate_columns(&self, inputs: &[Column], points: usize) -> Result<Vec<f64>, Error> {
        Ok(self.evaluate_columns_noting(inputs, points)?.0)
    }

    /// The outputs at many points, and the linear systems of deficient rank at some of them.
    ///
    /// # Errors
    /// If there are too few or too many inputs, or the length of an array is not `points`.
    pub fn evaluate_columns_noting(
        &self,
        inputs: &[Column],
        points: usize,
    ) -> Result<(Vec<f64>, BTreeSet<Deficiency>), Error> {
        self.check(inputs.len())?;
        for input in inputs {
            if let Column::Array(array) = input
                && array.len() != points
            {
                let (left, right) = ((array.len(), 1), (points, 1));
                return Err(Error::Shape { operation: "evaluation", left, right });
            }
        }
        let Some(length) = self.outputs.checked_mul(points) else {
            return Err(Error::Limit { what: "points", limit: usize::MAX / self.outputs, found: points });
        };
        if length == 0 {
            return Ok((Vec::new(), BTreeSet::new())); // however many points there are
        }
        let mut out = vec![0.0; length];
        let lanes = (CHUNK_BYTES / (8 * self.registers.max(1))).clamp(FEWEST_LANES, MOST_LANES);
        let mut registers = vec![vec![0.0; lanes]; self.registers];
        let mut memory = self.systems.memory(lanes);
        for start in (0..points).step_by(lanes) {
            let (len, systems) = (lanes.min(points - start), &self.systems);
            let chunk = Chunk { inputs, constants: &self.constants, systems, start, len };
            self.evaluate_chunk(&chunk, &mut registers, &mut memory, &mut out, points);
        }
        Ok((out, memory.deficiencies))
    }

    fn evaluate_chunk(
        &self,
        chunk: &Chunk,
        registers: &mut [Vec<f64>],
        memory: &mut Memory,
        out: &mut [f64],
        points: usize,
    ) {
        let first_register = self.constants.len() + self.inputs.len();
        let mut done = 0;
        for store in &self.stores {
            for step in &self.steps[done..store.steps] {
                // No instruction reads the register that it writes, so its lanes can be taken out meanwhile.
                let target = step.target as usize - first_register;
                let mut lanes = std::mem::take(&mut registers[target]);
                chunk.run(step.instruction, registers, memory, &mut lanes[..chunk.len]);
                registers[target] = lanes;
            }
            done = store.steps;
            let start = store.output * points + chunk.start;
            map1(&mut out[start..start + chunk.len], chunk.read(store.slot, registers), |x| x);
        }
    }

    fn check(&self, given: usize) -> Result<(), Error> {
        if given < self.inputs.len() {
            let names = self.inputs[given..].join(", ");
            let expected = self.inputs.len();
            return Err(Error::MissingInput(format!(
                "no value for {names}: {given} of {expected} inputs given"
            )));
        }
        if given > self.inputs.len() {
            return Err(Error::Limit { what: "inputs", limit: self.inputs.len(), found: given });
        }
        Ok(())
    }
}

/// A chunk of consecutive points.
struct Chunk<'a> {
    inputs: &'a [Column<'a>],
    constants: &'a [f64],
    systems: &'a LinearSystems,
    start: usize,
    len: usize,
}

impl Chunk<'_> {
    fn read<'a>(&'a self, slot: u32, registers: &'a [Vec<f64>]) -> Column<'a> {
        let slot = slot as usize;
        if let Some(&constant) = self.constants.get(slot) {
            return Column::Scalar(constant);
        }
        let slot = slot - self.constants.len();
        match self.inputs.get(slot) {
            Some(&scalar @ Column::Scalar(_)) => scalar,
            Some(Column::Array(array)) => Column::Array(&array[self.start..self.start + self.len]),
            None => Column::Array(&registers[slot - self.inputs.len()][..self.len]),
        }
    }

    fn run(
        &self,
        instruction: Instruction<u32>,
        registers: &[Vec<f64>],
        memory: &mut Memory,
        out: &mut [f64],
    ) {
        let at = |slot: u32, lane: usize| self.read(slot, registers).at(lane);
        let read = |slot| self.read(slot, registers);
        match instruction {
            Instruction::Add(a, b) => map2(out, read(a), read(b), |x, y| x + y),
            Instruction::Sub(a, b) => map2(out, read(a), read(b), |x, y| x - y),
            Instruction::Mul(a, b) => map2(out, read(a), read(b), |x, y| x * y),
            Instruction::Div(a, b) => map2(out, read(a), read(b), |x, y| x / y),
            Instruction::Neg(a) => map1(out, read(a), |x| -x),
            Instruction::Sqrt(a) => map1(out, read(a), f64::sqrt),
            Instruction::Unary(function, a) => map1(out, read(a), |x| function.evaluate(&[x])),
            Instruction::Binary(function, a, b) => {
                map2(out, read(a), read(b), |x, y| function.evaluate(&[x, y]));
            }
            Instruction::Select { condition, positive, otherwise } => {
                // First the default of the choice, then the lanes where the condition holds.
                map1(out, read(otherwise), |x| x);
                select(out, read(condition), read(positive));
            }
            Instruction::Factor(number) => self.systems.factor(number, self.len, memory, at),
            Instruction::Solve(number) => self.systems.solve(number, self.len, memory, at),
            Instruction::Component(number, index) => {
                for (lane, out) in out.iter_mut().enumerate() {
                    *out = self.systems.component(number, index, lane, memory);
                }
            }
        }
    }
}

fn map1(out: &mut [f64], a: Column, f: impl Fn(f64) -> f64) {
    match a {
        Column::Scalar(a) => out.fill(f(a)),
        Column::Array(a) => out.iter_mut().zip(a).for_each(|(out, &a)| *out = f(a)),
    }
}

fn map2(out: &mut [f64], a: Column, b: Column, f: impl Fn(f64, f64) -> f64) {
    match (a, b) {
        (Column::Scalar(a), Column::Scalar(b)) => out.fill(f(a, b)),
        (Column::Array(a), Column::Scalar(b)) => map1(out, Column::Array(a), |a| f(a, b)),
        (Column::Scalar(a), Column::Array(b)) => map1(out, Column::Array(b), |b| f(a, b)),
        (Column::Array(a), Column::Array(b)) => {
            out.iter_mut().zip(a).zip(b).for_each(|((out, &a), &b)| *out = f(a, b));
        }
    }
}

fn select(out: &mut [f64], condition: Column, positive: Column) {
    for (lane, out) in out.iter_mut().enumerate() {
        if condition.at(lane) > 0.0 {
            *out = positive.at(lane);
        }
    }
}

impl Column<'_> {
    const fn at(self, lane: usize) -> f64 {
        match self {
            Self::Scalar(value) => value,
            Self::Array(array) => array[lane],
        }
    }
}
