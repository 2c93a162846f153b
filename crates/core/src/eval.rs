//! Evaluation of a tape in doubles: at one point, or at many points, a block of them at a time.

use crate::error::Error;
use crate::tape::{Instruction, Operand, Tape};

/// Bytes of registers in a block of points: what the processor keeps close.
const BLOCK_BYTES: usize = 128 * 1024;
const MOST_LANES: usize = 256;
const FEWEST_LANES: usize = 16;

/// A tape made ready for evaluation: registers assigned.
#[derive(Clone, Debug)]
pub struct Evaluator {
    inputs: Vec<String>,
    constants: Vec<f64>,
    steps: Vec<Step>,
    /// Outputs that are computed, in the order of the steps.
    stores: Vec<Store>,
    /// Outputs that are inputs or constants.
    copies: Vec<(Operand, usize)>,
    outputs: usize,
    registers: usize,
}

/// An instruction over registers and where its result goes.
#[derive(Clone, Copy, Debug)]
struct Step {
    instruction: Instruction,
    target: u32,
}

/// The result of a step that is an output.
#[derive(Clone, Copy, Debug)]
struct Store {
    step: usize,
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
    /// Make a tape ready.
    #[must_use]
    pub fn new(tape: &Tape) -> Self {
        let registers = tape.registers();
        let in_register = |operand| match operand {
            Operand::Value(value) => Operand::Value(registers.of[value as usize]),
            _ => operand,
        };
        let step = |(instruction, &target): (&Instruction, &u32)| Step {
            instruction: instruction.map(in_register),
            target,
        };
        let (mut stores, mut copies) = (Vec::new(), Vec::new());
        for (output, &operand) in tape.outputs.iter().enumerate() {
            match operand {
                Operand::Value(value) => stores.push(Store { step: value as usize, output }),
                _ => copies.push((operand, output)),
            }
        }
        stores.sort_by_key(|store| store.step);
        Self {
            inputs: tape.inputs.clone(),
            constants: tape.constants.clone(),
            steps: tape.instructions.iter().zip(&registers.of).map(step).collect(),
            stores,
            copies,
            outputs: tape.outputs.len(),
            registers: registers.count,
        }
    }

    /// How many outputs there are.
    #[must_use]
    pub const fn outputs(&self) -> usize {
        self.outputs
    }

    /// The outputs at one point.
    ///
    /// # Errors
    /// When there are too few or too many inputs.
    pub fn evaluate(&self, inputs: &[f64]) -> Result<Vec<f64>, Error> {
        self.check(inputs.len())?;
        let mut out = vec![0.0; self.outputs];
        let mut registers = vec![0.0; self.registers];
        let mut stores = self.stores.iter().peekable();
        for (position, step) in self.steps.iter().enumerate() {
            let result = step.instruction.evaluate(|operand| match operand {
                Operand::Input(index) => inputs[index as usize],
                Operand::Constant(index) => self.constants[index as usize],
                Operand::Value(register) => registers[register as usize],
            });
            registers[step.target as usize] = result;
            while let Some(store) = stores.next_if(|store| store.step == position) {
                out[store.output] = result;
            }
        }
        for &(operand, output) in &self.copies {
            out[output] = match operand {
                Operand::Input(index) => inputs[index as usize],
                Operand::Constant(index) | Operand::Value(index) => self.constants[index as usize],
            };
        }
        Ok(out)
    }

    /// The outputs at many points: all points of the first output, then all of the second, and so on.
    ///
    /// # Errors
    /// When there are too few or too many inputs, or an array has not the length `points`.
    pub fn evaluate_columns(&self, inputs: &[Column], points: usize) -> Result<Vec<f64>, Error> {
        self.check(inputs.len())?;
        for input in inputs {
            if let Column::Array(array) = input
                && array.len() != points
            {
                let (left, right) = ((array.len(), 1), (points, 1));
                return Err(Error::Shape { operation: "evaluation", left, right });
            }
        }
        let mut out = vec![0.0; self.outputs * points];
        let lanes = (BLOCK_BYTES / (8 * self.registers.max(1))).clamp(FEWEST_LANES, MOST_LANES);
        let mut registers = vec![vec![0.0; lanes]; self.registers];
        for start in (0..points).step_by(lanes) {
            let block = Block { inputs, constants: &self.constants, start, len: lanes.min(points - start) };
            self.evaluate_block(&block, &mut registers, &mut out, points);
        }
        Ok(out)
    }

    fn evaluate_block(&self, block: &Block, registers: &mut [Vec<f64>], out: &mut [f64], points: usize) {
        let place = |output: usize| {
            let start = output * points + block.start;
            start..start + block.len
        };
        let mut stores = self.stores.iter().peekable();
        for (position, step) in self.steps.iter().enumerate() {
            // No instruction reads the register that it writes, so its lanes can be taken out meanwhile.
            let mut lanes = std::mem::take(&mut registers[step.target as usize]);
            block.run(step.instruction, registers, &mut lanes[..block.len]);
            while let Some(store) = stores.next_if(|store| store.step == position) {
                out[place(store.output)].copy_from_slice(&lanes[..block.len]);
            }
            registers[step.target as usize] = lanes;
        }
        for &(operand, output) in &self.copies {
            map1(&mut out[place(output)], block.read(operand, registers), |x| x);
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

/// Some consecutive points.
struct Block<'a> {
    inputs: &'a [Column<'a>],
    constants: &'a [f64],
    start: usize,
    len: usize,
}

impl Block<'_> {
    fn read<'a>(&'a self, operand: Operand, registers: &'a [Vec<f64>]) -> Column<'a> {
        match operand {
            Operand::Input(index) => match self.inputs[index as usize] {
                Column::Array(array) => Column::Array(&array[self.start..self.start + self.len]),
                scalar @ Column::Scalar(_) => scalar,
            },
            Operand::Constant(index) => Column::Scalar(self.constants[index as usize]),
            Operand::Value(register) => Column::Array(&registers[register as usize][..self.len]),
        }
    }

    fn run(&self, instruction: Instruction, registers: &[Vec<f64>], out: &mut [f64]) {
        let read = |operand| self.read(operand, registers);
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
                // First the choice's default, then the lanes where the condition holds.
                map1(out, read(otherwise), |x| x);
                select(out, read(condition), read(positive));
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
