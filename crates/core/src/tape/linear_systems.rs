//! The linear systems of a tape at run time: matrices and right sides gathered from slots, lane by lane.

use std::collections::BTreeSet;

use crate::graph::word;
use crate::kernel::Deficiency;
use crate::kernel::factorization::{factor, solve, workspace};

use super::straight_line::{Instruction, Operand, Tape};

/// The linear systems of a tape, over the slots of its evaluator.
#[derive(Clone, Debug, Default)]
pub(super) struct LinearSystems {
    matrices: Vec<GatheredMatrix>,
    solutions: Vec<GatheredSolution>,
}

#[derive(Clone, Debug)]
struct GatheredMatrix {
    size: usize,
    entries: Vec<u32>,
}

#[derive(Clone, Debug)]
struct GatheredSolution {
    matrix: usize,
    right: Vec<u32>,
}

/// Factorised matrices and solutions, for each of some lanes, and the systems of deficient rank.
pub(super) struct Memory {
    factorizations: Vec<Vec<f64>>,
    solutions: Vec<Vec<f64>>,
    pub(crate) deficiencies: BTreeSet<Deficiency>,
}

impl LinearSystems {
    pub(crate) fn new(tape: &Tape, slot: impl Fn(Operand) -> u32 + Copy) -> Self {
        let slots = |operands: &[Operand]| operands.iter().map(|&operand| slot(operand)).collect();
        let matrices = tape.factorizations.iter();
        let solutions = tape.solutions.iter();
        Self {
            matrices: matrices.map(|m| GatheredMatrix { size: m.size, entries: slots(&m.entries) }).collect(),
            solutions: solutions
                .map(|s| GatheredSolution {
                    matrix: matrix_of(tape, s.factorization),
                    right: slots(&s.right),
                })
                .collect(),
        }
    }

    pub(crate) fn memory(&self, lanes: usize) -> Memory {
        let area = |size: usize| vec![0.0; size * lanes];
        Memory {
            factorizations: self.matrices.iter().map(|matrix| area(workspace(matrix.size))).collect(),
            solutions: self.solutions.iter().map(|solution| area(solution.right.len())).collect(),
            deficiencies: BTreeSet::new(),
        }
    }

    /// Factorise a matrix in `lanes` lanes.
    pub(crate) fn factor(
        &self,
        number: u32,
        lanes: usize,
        memory: &mut Memory,
        read: impl Fn(u32, usize) -> f64,
    ) {
        let GatheredMatrix { size, entries } = &self.matrices[number as usize];
        let areas = memory.factorizations[number as usize].chunks_exact_mut(workspace(*size));
        for (lane, area) in areas.take(lanes).enumerate() {
            for (place, &slot) in area.iter_mut().zip(entries) {
                *place = read(slot, lane);
            }
            factor(*size, area);
        }
    }

    /// Solve a system in `lanes` lanes.
    pub(crate) fn solve(
        &self,
        number: u32,
        lanes: usize,
        memory: &mut Memory,
        read: impl Fn(u32, usize) -> f64,
    ) {
        let GatheredSolution { matrix, right } = &self.solutions[number as usize];
        let size = right.len();
        let factors = memory.factorizations[*matrix].chunks_exact_mut(workspace(size));
        let results = memory.solutions[number as usize].chunks_exact_mut(size);
        for (lane, (area, result)) in factors.zip(results).take(lanes).enumerate() {
            for (place, &slot) in result.iter_mut().zip(right) {
                *place = read(slot, lane);
            }
            memory.deficiencies.extend(Deficiency::of(word(*matrix), size, area, result));
            solve(size, area, result);
        }
    }

    /// A component of a solution in one lane.
    pub(crate) fn component(&self, number: u32, index: u32, lane: usize, memory: &Memory) -> f64 {
        let size = self.solutions[number as usize].right.len();
        memory.solutions[number as usize][lane * size + index as usize]
    }
}

/// The number of the matrix that an operand factorises.
fn matrix_of(tape: &Tape, operand: Operand) -> usize {
    match operand.value().map(|value| tape.instructions[value as usize]) {
        Some(Instruction::Factor(number)) => number as usize,
        _ => unreachable!("a system refers to its factorisation"),
    }
}

/// The number of the solution that an operand is.
pub(super) fn solution_of(tape: &Tape, operand: Operand) -> u32 {
    match operand.value().map(|value| tape.instructions[value as usize]) {
        Some(Instruction::Solve(number)) => number,
        _ => unreachable!("a component refers to its solution"),
    }
}
