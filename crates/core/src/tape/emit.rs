//! Arithmetic that writes a tape: signs travel with the operands, constants are folded, and nothing is written twice.

use rustc_hash::FxHashMap;
use std::cmp::Reverse;

use crate::graph::word;

use super::schedule::need;
use super::straight_line::{Factorization, Instruction, Operand, Solution, Tape};

const STORED: &str = "that the operand is a number was seen before";

/// An operand, or its opposite.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Signed {
    pub operand: Operand,
    pub negative: bool,
}

impl Signed {
    pub const fn plus(operand: Operand) -> Self {
        Self { operand, negative: false }
    }

    pub const fn flipped_if(self, flip: bool) -> Self {
        Self { operand: self.operand, negative: self.negative != flip }
    }
}

/// A tape under construction, in any order that has operands before their use.
#[derive(Default)]
pub(super) struct Emitter {
    pub tape: Tape,
    /// How many values the computation of each instruction holds at the same time.
    pub needs: Vec<u32>,
    written: FxHashMap<Instruction, Operand>,
    constants: FxHashMap<u64, u32>,
    factorized: FxHashMap<Vec<Operand>, Operand>,
}

impl Emitter {
    /// A constant whose sign travels: the stored number is not negative.
    pub fn constant(&mut self, value: f64) -> Signed {
        let negative = value < 0.0;
        Signed { operand: self.stored(if negative { -value } else { value }), negative }
    }

    fn stored(&mut self, value: f64) -> Operand {
        let constants = &mut self.tape.constants;
        Operand::Constant(*self.constants.entry(value.to_bits()).or_insert_with(|| {
            constants.push(value);
            word(constants.len()) - 1
        }))
    }

    /// The number that an operand is, if it is one.
    pub fn number_in(&self, value: Signed) -> Option<f64> {
        let number = self.stored_in(value.operand)?;
        Some(if value.negative { -number } else { number })
    }

    /// The number of a constant.
    fn stored_in(&self, operand: Operand) -> Option<f64> {
        match operand {
            Operand::Constant(index) => Some(self.tape.constants[index as usize]),
            _ => None,
        }
    }

    /// The operand itself, its sign applied.
    pub fn plain(&mut self, value: Signed) -> Operand {
        match self.stored_in(value.operand) {
            _ if !value.negative => value.operand,
            Some(number) => self.stored(-number),
            None => self.negated(value.operand),
        }
    }

    /// The opposite of an operand: one operation, or none if only the opposite is needed.
    fn negated(&mut self, operand: Operand) -> Operand {
        match self.definition(operand) {
            Some(Instruction::Sub(a, b)) => self.write(Instruction::Sub(b, a)),
            Some(
                Instruction::Mul(a @ Operand::Constant(_), b) | Instruction::Mul(b, a @ Operand::Constant(_)),
            ) => {
                let factor = self.plain(Signed { operand: a, negative: true });
                self.write(Instruction::Mul(factor, b))
            }
            Some(Instruction::Div(a @ Operand::Constant(_), b)) => {
                let above = self.plain(Signed { operand: a, negative: true });
                self.write(Instruction::Div(above, b))
            }
            _ => self.write(Instruction::Neg(operand)),
        }
    }

    fn definition(&self, operand: Operand) -> Option<Instruction> {
        match operand {
            Operand::Value(value) => Some(self.tape.instructions[value as usize]),
            _ => None,
        }
    }

    /// The result of an instruction, which is a constant when its operands are.
    pub fn emit(&mut self, instruction: Instruction) -> Signed {
        if instruction.operands().all(|operand| self.stored_in(operand).is_some()) {
            let result = instruction.evaluate(|operand| self.stored_in(operand).expect(STORED));
            return self.constant(result);
        }
        Signed::plus(self.write(match instruction {
            Instruction::Add(a, b) if b < a => Instruction::Add(b, a),
            Instruction::Mul(a, b) if b < a => Instruction::Mul(b, a),
            _ => instruction,
        }))
    }

    /// Like [`Self::emit`], with the sign applied.
    pub fn emit_plain(&mut self, instruction: Instruction) -> Operand {
        let result = self.emit(instruction);
        self.plain(result)
    }

    fn write(&mut self, instruction: Instruction) -> Operand {
        if let Some(&known) = self.written.get(&instruction) {
            return known;
        }
        let need = need(instruction.operands(), &self.needs);
        let result = self.append(instruction, need);
        self.written.insert(instruction, result);
        result
    }

    /// A matrix to be factorised, once.
    pub fn factor(&mut self, size: usize, entries: Vec<Operand>) -> Operand {
        if let Some(&known) = self.factorized.get(&entries) {
            return known;
        }
        let needs = self.need_of_all(&entries);
        self.tape.factorizations.push(Factorization { size, entries: entries.clone() });
        let result = self.append(Instruction::Factor(word(self.tape.factorizations.len()) - 1), needs);
        self.factorized.insert(entries, result);
        result
    }

    /// A linear system to be solved.
    pub fn solve(&mut self, factorization: Operand, right: Vec<Operand>) -> Operand {
        let needs = self.need_of_all(&right);
        self.tape.solutions.push(Solution { factorization, right });
        self.append(Instruction::Solve(word(self.tape.solutions.len()) - 1), needs)
    }

    /// A component of a solution.
    pub fn component(&mut self, solution: Operand, index: u32) -> Signed {
        Signed::plus(self.write(Instruction::Component(solution, index)))
    }

    /// The number of values that a list holds: all its entries live until the last one is computed.
    fn need_of_all(&self, operands: &[Operand]) -> u32 {
        let needs = operands.iter().map(|&operand| self.need_of(Signed::plus(operand)));
        needs.max().unwrap_or(0) + word(operands.len())
    }

    fn append(&mut self, instruction: Instruction, need: u32) -> Operand {
        let result = Operand::Value(word(self.tape.instructions.len()));
        self.needs.push(need);
        self.tape.instructions.push(instruction);
        result
    }

    pub fn add(&mut self, a: Signed, b: Signed) -> Signed {
        match (a.negative, b.negative) {
            (false, true) => self.emit(Instruction::Sub(a.operand, b.operand)),
            (true, false) => self.emit(Instruction::Sub(b.operand, a.operand)),
            (negative, _) => self.emit(Instruction::Add(a.operand, b.operand)).flipped_if(negative),
        }
    }

    pub fn multiply(&mut self, a: Signed, b: Signed) -> Signed {
        let product = match (self.stored_in(a.operand), self.stored_in(b.operand)) {
            (Some(factor), None) => self.scaled(b.operand, factor),
            (None, Some(factor)) => self.scaled(a.operand, factor),
            _ => self.emit(Instruction::Mul(a.operand, b.operand)),
        };
        product.flipped_if(a.negative != b.negative)
    }

    pub fn divide(&mut self, a: Signed, b: Signed) -> Signed {
        self.emit(Instruction::Div(a.operand, b.operand)).flipped_if(a.negative != b.negative)
    }

    /// A multiple; a multiple of a multiple, or of a number over something, merges the constants.
    fn scaled(&mut self, operand: Operand, factor: f64) -> Signed {
        if factor.to_bits() == 1f64.to_bits() {
            return Signed::plus(operand);
        }
        let merged = |number: Option<f64>| number.map(|n| n * factor).filter(|product| product.is_normal());
        match self.definition(operand) {
            Some(Instruction::Mul(a, b)) if merged(self.stored_in(a)).is_some() => {
                self.scaled_by(a, b, factor)
            }
            Some(Instruction::Mul(a, b)) if merged(self.stored_in(b)).is_some() => {
                self.scaled_by(b, a, factor)
            }
            Some(Instruction::Div(a, b)) => match merged(self.stored_in(a)) {
                Some(product) => {
                    let above = self.constant(product);
                    self.divide(above, Signed::plus(b))
                }
                None => self.times(operand, factor),
            },
            _ => self.times(operand, factor),
        }
    }

    fn scaled_by(&mut self, constant: Operand, operand: Operand, factor: f64) -> Signed {
        let product = self.stored_in(constant).expect(STORED) * factor;
        self.times(operand, product)
    }

    fn times(&mut self, operand: Operand, factor: f64) -> Signed {
        let factor = self.constant(factor);
        self.emit(Instruction::Mul(factor.operand, operand)).flipped_if(factor.negative)
    }

    /// The product of all factors; `None` if there are none. Factors whose computation holds many values come first.
    pub fn multiply_all(&mut self, mut factors: Vec<Signed>) -> Option<Signed> {
        factors.sort_by_key(|&factor| Reverse(self.need_of(factor)));
        factors.into_iter().reduce(|a, b| self.multiply(a, b))
    }

    pub fn need_of(&self, value: Signed) -> u32 {
        match value.operand {
            Operand::Value(index) => self.needs[index as usize],
            _ => 0,
        }
    }

    /// base ** n, or base ** (n/2), by squaring; the squares are shared by all powers of the base.
    pub fn power(&mut self, base: Signed, n: u64, halves: bool) -> Signed {
        let mut left = if halves { n / 2 } else { n };
        let mut power = None;
        if halves && n % 2 == 1 {
            let base = self.plain(base);
            power = Some(self.emit(Instruction::Sqrt(base)));
        }
        let mut square = base;
        while left > 0 {
            if left % 2 == 1 {
                power = Some(power.map_or(square, |power| self.multiply(square, power)));
            }
            left /= 2;
            if left > 0 {
                square = self.multiply(square, square);
            }
        }
        power.unwrap_or_else(|| self.constant(1.0))
    }
}
