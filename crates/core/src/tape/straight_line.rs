//! The tape: straight-line code over doubles, the common source of evaluation and of generated code.
//!
//! An instruction defines one value and refers to earlier ones (static single assignment). The order keeps
//! live ranges short, and [`Tape::registers`] maps the values onto few registers.

use crate::graph::{Cost, Function, factoring, solving, word};

/// The source of an argument of an instruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Operand {
    /// The input of this number.
    Input(u32),
    /// The constant of this number.
    Constant(u32),
    /// The result of the instruction of this number; once registers are assigned, the register.
    Value(u32),
}

impl Operand {
    /// The number of the instruction whose result it is.
    #[must_use]
    pub const fn value(self) -> Option<u32> {
        match self {
            Self::Value(value) => Some(value),
            _ => None,
        }
    }
}

/// One operation on doubles. Its arguments are operands, or places of another kind `P`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Instruction<P = Operand> {
    /// The sum `a + b`.
    Add(P, P),
    /// The difference `a - b`.
    Sub(P, P),
    /// The product `a * b`.
    Mul(P, P),
    /// The quotient `a / b`.
    Div(P, P),
    /// The opposite `-a`.
    Neg(P),
    /// The square root of a.
    Sqrt(P),
    /// A function of one argument.
    Unary(Function, P),
    /// A function of two arguments: atan2, power, the smaller or the larger of two.
    Binary(Function, P, P),
    /// One value where the condition is positive, the other elsewhere.
    Select {
        /// The condition.
        condition: P,
        /// The value where the condition is positive.
        positive: P,
        /// The value where it is zero, negative or not a number.
        otherwise: P,
    },
    /// The factorisation of this number in the tape's list.
    Factor(u32),
    /// The solution of this number in the tape's list.
    Solve(u32),
    /// A component of a solution.
    Component(P, u32),
}

impl<P: Copy> Instruction<P> {
    /// The arguments in the instruction itself; those of factorisations and solutions are in the lists of the tape.
    pub fn operands(self) -> impl DoubleEndedIterator<Item = P> {
        let [a, b, c] = match self {
            Self::Add(a, b) | Self::Sub(a, b) | Self::Mul(a, b) | Self::Div(a, b) | Self::Binary(_, a, b) => {
                [Some(a), Some(b), None]
            }
            Self::Neg(a) | Self::Sqrt(a) | Self::Unary(_, a) | Self::Component(a, _) => [Some(a), None, None],
            Self::Select { condition, positive, otherwise } => {
                [Some(condition), Some(positive), Some(otherwise)]
            }
            Self::Factor(_) | Self::Solve(_) => [None, None, None],
        };
        [a, b, c].into_iter().flatten()
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
            Self::Factor(number) => Instruction::Factor(number),
            Self::Solve(number) => Instruction::Solve(number),
            Self::Component(a, index) => Instruction::Component(f(a), index),
        }
    }

    /// The result, given the arguments; NaN for linear systems, which are not solved by one operation.
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
            Self::Factor(_) | Self::Solve(_) | Self::Component(..) => f64::NAN,
        }
    }
}

/// A matrix to be factorised at run time.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Factorization {
    /// The number of rows and columns.
    pub size: usize,
    /// The entries, row by row.
    pub entries: Vec<Operand>,
}

/// A linear system to be solved at run time.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Solution {
    /// The factorised matrix: the result of an instruction.
    pub factorization: Operand,
    /// The right side.
    pub right: Vec<Operand>,
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
    /// The operand of each output.
    pub outputs: Vec<Operand>,
    /// The matrices of the linear systems in the code.
    pub factorizations: Vec<Factorization>,
    /// The linear systems in the code.
    pub solutions: Vec<Solution>,
}

/// A register for each value; values that live at the same time have different registers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Registers {
    /// The register of each instruction's result; never one that the instruction itself reads.
    pub of: Vec<u32>,
    /// The number of registers.
    pub count: usize,
}

impl Tape {
    /// The places of the first input and of the first value, where constants, inputs and values are counted as one list.
    #[must_use]
    pub fn first_places(&self) -> (u32, u32) {
        (word(self.constants.len()), word(self.constants.len() + self.inputs.len()))
    }

    /// The operations of the code, counted like those of expressions: a change of sign on its own is an addition.
    #[must_use]
    pub fn operations(&self) -> Cost {
        let mut cost = Cost::default();
        for position in 0..self.instructions.len() {
            cost += self.cost_of(position);
        }
        cost
    }

    /// The operations of the instruction at a position.
    pub(super) fn cost_of(&self, position: usize) -> Cost {
        let none = Cost::default();
        match self.instructions[position] {
            Instruction::Add(..) | Instruction::Sub(..) | Instruction::Neg(_) => {
                Cost { additions: 1, ..none }
            }
            Instruction::Mul(..) => Cost { multiplications: 1, ..none },
            Instruction::Div(..) => Cost { divisions: 1, ..none },
            Instruction::Factor(number) => factoring(self.factorizations[number as usize].size),
            Instruction::Solve(number) => solving(self.solutions[number as usize].right.len()),
            Instruction::Component(..) => none,
            _ => Cost { functions: 1, ..none },
        }
    }

    /// The instructions in the given sequence; all others are dropped. An argument must come before its uses.
    pub(super) fn reordered(&self, sequence: &[u32]) -> Self {
        let mut places = Places::new(self, sequence);
        let mut tape = Self { inputs: self.inputs.clone(), ..Self::default() };
        for &old in sequence {
            let instruction = match self.instructions[old as usize] {
                Instruction::Factor(number) => {
                    let Factorization { size, entries } = &self.factorizations[number as usize];
                    let entries = entries.iter().map(|&entry| places.of(entry)).collect();
                    tape.factorizations.push(Factorization { size: *size, entries });
                    Instruction::Factor(word(tape.factorizations.len()) - 1)
                }
                Instruction::Solve(number) => {
                    let Solution { factorization, right } = &self.solutions[number as usize];
                    let right = right.iter().map(|&entry| places.of(entry)).collect();
                    tape.solutions.push(Solution { factorization: places.of(*factorization), right });
                    Instruction::Solve(word(tape.solutions.len()) - 1)
                }
                other => other.map(|operand| places.of(operand)),
            };
            tape.instructions.push(instruction);
        }
        tape.outputs = self.outputs.iter().map(|&output| places.of(output)).collect();
        tape.constants = places.constants;
        tape
    }

    /// The operands that the instruction at a position reads.
    pub fn reads(&self, position: usize) -> impl DoubleEndedIterator<Item = Operand> {
        let instruction = self.instructions[position];
        let (first, rest): (Option<Operand>, &[Operand]) = match instruction {
            Instruction::Factor(number) => (None, &self.factorizations[number as usize].entries),
            Instruction::Solve(number) => {
                let solution = &self.solutions[number as usize];
                (Some(solution.factorization), &solution.right)
            }
            _ => (None, &[]),
        };
        first.into_iter().chain(rest.iter().copied()).chain(instruction.operands())
    }

    /// The values that the instruction at a position reads, each once, by number.
    pub fn values_read(&self, position: usize) -> Vec<u32> {
        let mut values: Vec<u32> = self.reads(position).filter_map(Operand::value).collect();
        values.sort_unstable();
        values.dedup();
        values
    }

    /// Assign registers by a linear scan; an output is read from its register as soon as it is computed.
    #[must_use]
    pub fn registers(&self) -> Registers {
        let last_use = self.last_uses();
        let mut of: Vec<u32> = Vec::with_capacity(self.instructions.len());
        let mut free: Vec<u32> = Vec::new();
        let mut count = 0;
        for position in 0..self.instructions.len() {
            let register = free.pop().unwrap_or_else(|| {
                count += 1;
                count - 1
            });
            of.push(register);
            let values = self.values_read(position).into_iter();
            let mut dead: Vec<u32> = values
                .filter(|&value| last_use[value as usize] == position)
                .map(|value| of[value as usize])
                .collect();
            dead.sort_unstable();
            free.extend(dead);
            if last_use[position] == position {
                free.push(register);
            }
        }
        Registers { of, count: count as usize }
    }

    /// The last instruction that reads each value, or the value's own place if none does.
    fn last_uses(&self) -> Vec<usize> {
        let mut last: Vec<usize> = (0..self.instructions.len()).collect();
        for position in 0..self.instructions.len() {
            for value in self.reads(position).filter_map(Operand::value) {
                last[value as usize] = position;
            }
        }
        last
    }
}

/// The places of the operands of a tape in another order of its instructions.
struct Places<'a> {
    tape: &'a Tape,
    values: Vec<Option<u32>>,
    /// The new place of each constant that has one: in the order of first use.
    kept: Vec<Option<u32>>,
    constants: Vec<f64>,
}

impl<'a> Places<'a> {
    fn new(tape: &'a Tape, sequence: &[u32]) -> Self {
        let mut values = vec![None; tape.instructions.len()];
        for (new, &old) in (0..).zip(sequence) {
            values[old as usize] = Some(new);
        }
        Self { tape, values, kept: vec![None; tape.constants.len()], constants: Vec::new() }
    }

    fn of(&mut self, operand: Operand) -> Operand {
        match operand {
            Operand::Input(_) => operand,
            Operand::Value(value) => {
                let place = self.values[value as usize];
                Operand::Value(place.expect("what an instruction reads is in the sequence"))
            }
            Operand::Constant(constant) => {
                Operand::Constant(*self.kept[constant as usize].get_or_insert_with(|| {
                    self.constants.push(self.tape.constants[constant as usize]);
                    word(self.constants.len()) - 1
                }))
            }
        }
    }
}
