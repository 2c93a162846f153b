//! Derivatives that are zero, though their forms do not show it.
//!
//! The derivative by a variable on which the value does not depend is zero, such as that of |c (x + 3)|/|x + 3| by x. Its form
//! shows that only where the lanes know the identities by which x cancels. So a derivative that is zero in double precision
//! is examined by the value of the expression: does it stay the same with another variable in the place of this one?

use crate::graph::{Assumption, Graph, Id, View};

/// The largest derivative, beside the expression, that may be rounding of zero.
const ROUNDING: f64 = 1e-9;

/// The variables by which an expression is differentiated.
#[derive(Clone, Copy)]
pub(super) enum Variables<'a> {
    /// Those of the entries of a row.
    Each(&'a [Id]),
    /// All that depend on time: the row has one entry.
    OfTime,
}

impl Graph {
    /// Replace derivatives of an expression by zero where its value does not depend on the variables.
    pub(super) fn settle_vanishing(&mut self, id: Id, variables: Variables<'_>, row: &mut [Id]) {
        for place in self.seemingly_vanishing(id, row) {
            let variables = match variables {
                Variables::Each(variables) => vec![variables[place]],
                Variables::OfTime => {
                    self.variables(&[id]).into_iter().filter(|&leaf| self.depends_on_time(leaf)).collect()
                }
            };
            if self.is_idle_by_value(id, &variables) {
                row[place] = Id::ZERO;
            }
        }
    }

    /// The places of the derivatives that are zero in double precision wherever the expression is real.
    fn seemingly_vanishing(&self, id: Id, row: &[Id]) -> Vec<usize> {
        let mut places: Vec<usize> = (0..row.len()).filter(|&k| self.as_number(row[k]).is_none()).collect();
        if places.is_empty() {
            return places;
        }
        let Some(points) = self.numbers_at_points(&[&[id], row].concat()) else { return Vec::new() };
        for values in points.filter(|values| values[0].is_finite()) {
            places.retain(|k| values[k + 1].abs() <= ROUNDING * values[0].abs());
            if places.is_empty() {
                break;
            }
        }
        places
    }

    /// Whether the value of an expression stays the same if others take the places of some variables.
    fn is_idle_by_value(&mut self, id: Id, variables: &[Id]) -> bool {
        let mut pairs: Vec<(Id, Id)> =
            variables.iter().flat_map(|&each| self.rates_of(each, &[id])).collect();
        pairs.retain(|(rate, _)| !variables.contains(rate));
        for (&variable, place) in variables.iter().zip(0..) {
            let assumption = match self.view(variable) {
                View::Symbol(_, assumption) | View::TimeFunction(_, _, assumption) => assumption,
                _ => Assumption::Real,
            };
            let other = self.symbol(&format!("other variable {place}, {assumption:?}"), assumption);
            pairs.push((variable, other));
        }
        self.substitute(&[id], &pairs).is_ok_and(|replaced| self.equal(id, replaced[0]))
    }
}
