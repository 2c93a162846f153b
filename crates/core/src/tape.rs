//! The tape: straight-line code over doubles, the common source of evaluation and of generated code.
//!
//! An instruction defines one value and refers to earlier ones (static single assignment). The order keeps
//! live ranges short, and [`Tape::registers`] maps the values onto few registers.

use crate::cost::Cost;
use crate::function::Function;

/// Where an instruction takes an argument from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Operand {
    /// The input of this number.
    Input(u32),
    /// The constant of this number.
    Constant(u32),
    /// The result of the instruction of this number; once registers are assigned, the register.
    Value(u32),
}

/// One operation on doubles; its arguments are operands, or places of another kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Instruction<P = Operand> {
    /// a + b
    Add(P, P),
    /// a - b
    Sub(P, P),
    /// a * b
    Mul(P, P),
    /// a / b
    Div(P, P),
    /// -a
    Neg(P),
    /// The square root of a.
    Sqrt(P),
    /// A function of one argument.
    Unary(Function, P),
    /// A function of two arguments: atan2, power, the smaller or the larger of two.
    Binary(Function, P, P),
    /// One value where the condition is positive, the other elsewhere.
    Select {
        /// What decides.
        condition: P,
        /// The value where the condition is positive.
        positive: P,
        /// The value where it is zero, negative or no number.
        otherwise: P,
    },
}

impl<P: Copy> Instruction<P> {
    /// The arguments; places that an instruction has no use for repeat its first argument.
    #[must_use]
    pub const fn operands(self) -> [P; 3] {
        match self {
            Self::Add(a, b) | Self::Sub(a, b) | Self::Mul(a, b) | Self::Div(a, b) | Self::Binary(_, a, b) => {
                [a, b, a]
            }
            Self::Neg(a) | Self::Sqrt(a) | Self::Unary(_, a) => [a, a, a],
            Self::Select { condition, positive, otherwise } => [condition, positive, otherwise],
        }
    }

    /// The same operation on other arguments.
    #[must_use]
    pub fn map<Q>(self, mut f: impl FnMut(P) -> Q) -> Instruction<Q> {
        match self {
            Self::Add(a, b) => Instruction::Add(f(a), f(b)),
            Self::Sub(a, b) => Instruction::Sub(f(a), f(b)),
            Self::Mul(a, b) => Instruction::Mul(f(a), f(b)),
            Self::Div(a, b) => Instruction::Div(f(a), f(b)),
            Self::Neg(a) => Instruction::Neg(f(a)),
            Self::Sqrt(a) => Instruction::Sqrt(f(a)),
            Self::Unary(function, a) => Instruction::Unary(function, f(a)),
            Self::Binary(function, a, b) => Instruction::Binary(function, f(a), f(b)),
            Self::Select { condition, positive, otherwise } => Instruction::Select {
                condition: f(condition),
                positive: f(positive),
                otherwise: f(otherwise),
            },
        }
    }

    /// The result, given the arguments.
    #[must_use]
    pub fn evaluate(self, read: impl Fn(P) -> f64) -> f64 {
        match self {
            Self::Add(a, b) => read(a) + read(b),
            Self::Sub(a, b) => read(a) - read(b),
            Self::Mul(a, b) => read(a) * read(b),
            Self::Div(a, b) => read(a) / read(b),
            Self::Neg(a) => -read(a),
            Self::Sqrt(a) => read(a).sqrt(),
            Self::Unary(function, a) => function.evaluate(&[read(a)]),
            Self::Binary(function, a, b) => function.evaluate(&[read(a), read(b)]),
            Self::Select { condition, positive, otherwise } => {
                if read(condition) > 0.0 {
                    read(positive)
                } else {
                    read(otherwise)
                }
            }
        }
    }
}

/// Straight-line code from inputs to outputs.
///
/// Invariant: an instruction refers to earlier instructions only, and every one is needed by an output.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tape {
    /// The names of the inputs, in the order of their values.
    pub inputs: Vec<String>,
    /// The numbers in the code, each once.
    pub constants: Vec<f64>,
    /// The code; instruction i defines `Operand::Value(i)`.
    pub instructions: Vec<Instruction>,
    /// Where the outputs are found.
    pub outputs: Vec<Operand>,
}

/// A register for each value: values that live at the same time are in different registers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Registers {
    /// The register of each instruction's result; never one that the instruction itself reads.
    pub of: Vec<u32>,
    /// How many registers there are.
    pub count: usize,
}

impl Tape {
    /// The operations of the code, counted as those of expressions are: a lone change of sign is an addition.
    #[must_use]
    pub fn operations(&self) -> Cost {
        let mut cost = Cost::default();
        for instruction in &self.instructions {
            match instruction {
                Instruction::Add(..) | Instruction::Sub(..) | Instruction::Neg(_) => cost.additions += 1,
                Instruction::Mul(..) => cost.multiplications += 1,
                Instruction::Div(..) => cost.divisions += 1,
                _ => cost.functions += 1,
            }
        }
        cost
    }

    /// Assign registers by a linear scan; an output is taken from its register as soon as it is there.
    #[must_use]
    pub fn registers(&self) -> Registers {
        let last_use = self.last_uses();
        let mut of: Vec<u32> = Vec::with_capacity(self.instructions.len());
        let mut free: Vec<u32> = Vec::new();
        let mut count = 0;
        for (position, instruction) in self.instructions.iter().enumerate() {
            let register = free.pop().unwrap_or_else(|| {
                count += 1;
                count - 1
            });
            of.push(register);
            let mut dead = instruction.operands().map(|operand| match operand {
                Operand::Value(value) if last_use[value as usize] == position => Some(of[value as usize]),
                _ => None,
            });
            dead.sort_unstable();
            free.extend(
                dead.iter().enumerate().filter(|&(i, r)| i == 0 || dead[i - 1] != *r).filter_map(|(_, r)| *r),
            );
            if last_use[position] == position {
                free.push(register);
            }
        }
        Registers { of, count: count as usize }
    }

    /// The last instruction that reads each value; the value's own place when none does.
    fn last_uses(&self) -> Vec<usize> {
        let mut last: Vec<usize> = (0..self.instructions.len()).collect();
        for (position, instruction) in self.instructions.iter().enumerate() {
            for operand in instruction.operands() {
                if let Operand::Value(value) = operand {
                    last[value as usize] = position;
                }
            }
        }
        last
    }
}
