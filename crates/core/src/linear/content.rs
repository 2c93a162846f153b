//! Contents: the factors that all entries of a row or a column have in common.
//!
//! They are taken out before a system is solved: then they don't enlarge the minors, and needn't be cancelled
//! afterwards.

use crate::error::Error;
use crate::graph::{Graph, Id, NumberId, View};
use crate::value::Number;

type Powers = Vec<(Id, Number)>;

impl Graph {
    /// Divide each row of an augmented matrix by its content, which does not change the solution.
    pub(super) fn divide_rows(&mut self, rows: &mut [Vec<Id>]) -> Result<(), Error> {
        for row in rows {
            let content = self.content(row)?;
            for entry in row {
                *entry = self.div(*entry, content)?;
            }
        }
        Ok(())
    }

    /// Divide each column but the last by its content, including numbers; return the contents, by which the solution
    /// must be divided.
    pub(super) fn divide_columns(&mut self, rows: &mut [Vec<Id>]) -> Result<Vec<Id>, Error> {
        let unknowns = rows.len();
        let mut contents = Vec::with_capacity(unknowns);
        for column in 0..unknowns {
            let entries: Vec<Id> = rows.iter().map(|row| row[column]).collect();
            let content = self.content(&entries)?;
            let number = self.first_coefficient(&entries);
            let content = self.scale(number, content);
            for row in rows.iter_mut() {
                row[column] = self.div(row[column], content)?;
            }
            contents.push(content);
        }
        Ok(contents)
    }

    /// The product of the powers that every entry other than zero has as a factor.
    fn content(&mut self, entries: &[Id]) -> Result<Id, Error> {
        let mut common: Option<Powers> = None;
        for &entry in entries.iter().filter(|&&entry| entry != Id::ZERO) {
            let powers = self.powers(entry);
            common = Some(match common {
                None => powers,
                Some(common) => self.common_powers(common, &powers),
            });
        }
        let common = common.unwrap_or_default();
        let common: Vec<_> = common.iter().map(|(base, e)| (*base, self.number_id(e))).collect();
        self.product(&common)
    }

    fn first_coefficient(&self, entries: &[Id]) -> NumberId {
        let first = entries.iter().find(|&&entry| entry != Id::ZERO);
        match first.map(|&entry| self.view(entry)) {
            Some(View::Scale(number, _) | View::Number(number)) => number,
            _ => NumberId::ONE,
        }
    }

    /// The factors of a node without its numeric coefficient.
    fn powers(&self, id: Id) -> Powers {
        match self.view(id) {
            View::Number(_) => Powers::new(),
            View::Scale(_, child) => self.powers(child),
            View::Product(factors) => {
                factors.iter().map(|(base, e)| (base, self.get_number(e).clone())).collect()
            }
            _ => vec![(id, Number::integer(1))],
        }
    }

    fn common_powers(&self, common: Powers, others: &[(Id, Number)]) -> Powers {
        let shared = |(base, exponent): (Id, Number)| {
            let (_, other) = others.iter().find(|(known, _)| self.same(*known, base))?;
            if exponent.is_negative() != other.is_negative() {
                return None;
            }
            let smaller = exponent.abs().compare(&other.abs()).is_le();
            Some((base, if smaller { exponent } else { other.clone() }))
        };
        common.into_iter().filter_map(shared).collect()
    }
}
