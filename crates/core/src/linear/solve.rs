//! Linear systems in symbols: coefficients, rank, blocks, and Cramer's rule for each block.

use crate::error::Error;
use crate::graph::{Graph, Id, NumberId};

use super::block::{Block, blocks};
use super::form::LinearForm;
use super::rank::{Dependent, Equation, Rank};

/// The most unknowns that are solved together.
const MOST_COUPLED: usize = 6;
/// Equations up to this many characters are quoted in messages.
const QUOTED: usize = 60;

impl Graph {
    /// The unknowns that make the equations zero, by fraction-free elimination.
    ///
    /// Unknowns are symbols, functions of time, their derivatives, or applications of undefined functions. Systems
    /// that can be solved on their own are solved first, so that only the number of coupled unknowns is limited.
    /// There may be more equations than unknowns if they are consistent.
    ///
    /// # Errors
    /// If an equation is not linear, the equations contradict each other or leave unknowns free, or too many unknowns
    /// are coupled.
    pub fn solve(&mut self, equations: &[Id], unknowns: &[Id]) -> Result<Vec<Id>, Error> {
        self.check_distinct(unknowns)?;
        let forms = self.linear_forms(equations, unknowns)?;
        let equations_in_unknowns: Vec<Equation> =
            forms.iter().map(|form| equation_of(form, unknowns.len())).collect();
        let rank = self.rank_of(&equations_in_unknowns, unknowns.len());
        self.check_rank(&rank, equations, unknowns)?;
        let forms: Vec<LinearForm> = rank.independent.iter().map(|&i| forms[i].clone()).collect();
        let pattern: Vec<Vec<usize>> =
            forms.iter().map(|form| form.coefficients.keys().copied().collect()).collect();
        let mut solution: Vec<Option<Id>> = vec![None; unknowns.len()];
        for block in blocks(&pattern, unknowns.len()) {
            self.solve_block(&block, &forms, &mut solution)?;
        }
        Ok(solution.into_iter().map(solved).collect())
    }

    fn check_distinct(&self, unknowns: &[Id]) -> Result<(), Error> {
        for (position, &unknown) in unknowns.iter().enumerate() {
            if unknowns[..position].iter().any(|&other| self.equal(unknown, other)) {
                return Err(Error::Singular(format!("the unknown {} is given twice", self.to_text(unknown))));
            }
        }
        Ok(())
    }

    fn check_rank(&self, rank: &Rank, equations: &[Id], unknowns: &[Id]) -> Result<(), Error> {
        if let Some(wrong) = rank.dependent.iter().find(|dependent| dependent.contradicts) {
            let equation = self.quote(wrong.equation, equations);
            let others = if wrong.on.is_empty() {
                "contains none of the unknowns and is not zero".to_owned()
            } else {
                format!("contradicts {}", numbered(&wrong.on))
            };
            return Err(Error::Singular(format!("no solution: {equation} {others}")));
        }
        if rank.free.is_empty() {
            return Ok(());
        }
        let free: Vec<String> = rank.free.iter().map(|&unknown| self.to_text(unknowns[unknown])).collect();
        let count = match rank.independent.len() {
            1 => "1 independent equation".to_owned(),
            count => format!("{count} independent equations"),
        };
        let mut text = format!("{count} for {} unknowns leave {} free", unknowns.len(), free.join(", "));
        for Dependent { equation, on, .. } in &rank.dependent {
            let origin = if on.is_empty() {
                "is always true".to_owned()
            } else {
                format!("follows from {}", numbered(on))
            };
            text = format!("{text}; {} {origin}", self.quote(*equation, equations));
        }
        Err(Error::Singular(text + ": add equations, or solve for fewer unknowns"))
    }

    /// An equation by its number, and in full if it is short.
    fn quote(&self, equation: usize, equations: &[Id]) -> String {
        let text = self.to_text(equations[equation]);
        let number = equation + 1;
        if text.chars().count() > QUOTED || text.contains('\n') {
            format!("equation {number}")
        } else {
            format!("equation {number} ({text} = 0)")
        }
    }

    fn solve_block(
        &mut self,
        block: &Block,
        forms: &[LinearForm],
        solution: &mut [Option<Id>],
    ) -> Result<(), Error> {
        let found = block.unknowns.len();
        if found > MOST_COUPLED {
            let what = "coupled unknowns of a linear system in symbols (solve fewer at a time, or give numbers \
                        to the coefficients and solve numerically)";
            return Err(Error::Limit { what, limit: MOST_COUPLED, found });
        }
        let mut rows = Vec::with_capacity(found);
        for &equation in &block.equations {
            rows.push(self.augmented_row(&forms[equation], &block.unknowns, solution)?);
        }
        for (&unknown, value) in block.unknowns.iter().zip(self.cramer(rows)?) {
            solution[unknown] = Some(value);
        }
        Ok(())
    }

    /// The coefficients of the block's unknowns and the right-hand side, with the solved unknowns substituted.
    fn augmented_row(
        &mut self,
        form: &LinearForm,
        unknowns: &[usize],
        solution: &[Option<Id>],
    ) -> Result<Vec<Id>, Error> {
        let coefficient = |unknown: &usize| form.coefficients.get(unknown).copied().unwrap_or(Id::ZERO);
        let mut row: Vec<Id> = unknowns.iter().map(coefficient).collect();
        let mut right = vec![(NumberId::MINUS_ONE, form.constant)];
        for (&unknown, &coefficient) in &form.coefficients {
            if let Some(value) = solution[unknown] {
                right.push((NumberId::MINUS_ONE, self.mul(coefficient, value)?));
            }
        }
        row.push(self.sum(&right));
        Ok(row)
    }
}

/// The value of an unknown after all blocks.
fn solved(value: Option<Id>) -> Id {
    value.expect("the blocks cover all unknowns, because the rank leaves none free")
}

/// "equation 2", "equations 1 and 2", "equations 1, 2 and 3"
fn numbered(equations: &[usize]) -> String {
    let numbers: Vec<String> = equations.iter().map(|equation| (equation + 1).to_string()).collect();
    match &numbers[..] {
        [] => "no equation".to_owned(),
        [one] => format!("equation {one}"),
        [first @ .., last] => format!("equations {} and {last}", first.join(", ")),
    }
}

fn equation_of(form: &LinearForm, unknowns: usize) -> Equation {
    let coefficients = form.coefficients.iter().map(|(&number, &id)| (number, id));
    coefficients.chain([(unknowns, form.constant)]).collect()
}
