//! The rank of a linear system, found in the finite field: the equations that are independent.
//!
//! Elimination of values costs nothing compared with elimination of expressions. It shows in advance which equations
//! depend on which others, and which unknowns stay free.

use std::collections::BTreeMap;

use crate::graph::{Flags, Graph, Id};
use crate::interrupt::tick;
use crate::value::{Field, FieldId, Quadratic};

/// Signs and roots may make equations dependent in one lane, so the greatest rank in this many lanes counts.
const LANES: usize = 8;

/// An equation: unknowns by number, the constant under the number after the last.
pub(crate) type Equation = Vec<(usize, Id)>;

/// An equation at a random point.
type Row = BTreeMap<usize, Quadratic>;

/// An equation whose left side is a combination of those of earlier ones.
pub(super) struct Dependent {
    pub equation: usize,
    /// The earlier equations, all independent.
    pub on: Vec<usize>,
    /// Whether the constants differ, so that there is no solution.
    pub contradicts: bool,
}

/// What is known about a system before it is solved.
pub(crate) struct Rank {
    pub independent: Vec<usize>,
    pub dependent: Vec<Dependent>,
    /// Unknowns that the equations leave free.
    pub free: Vec<usize>,
}

/// A reduced equation, and the combination of the given equations that gives it.
struct Reduced {
    row: Row,
    combination: Row,
}

impl Graph {
    /// The rank of equations in `unknowns` unknowns at almost every point.
    pub(super) fn rank_of(&self, equations: &[Equation], unknowns: usize) -> Rank {
        let branches =
            |equation: &Equation| equation.iter().any(|&(_, id)| self.flags(id).has(Flags::BRANCH));
        let lanes = if equations.iter().any(branches) { LANES } else { 1 };
        let in_field = |field: FieldId| {
            let values = |equation: &Equation| -> Row {
                let all = equation.iter().map(|&(number, id)| (number, self.value_in(id, field)));
                all.filter(|(_, value)| !value.is_zero()).collect()
            };
            rank(equations.iter().map(values).collect(), unknowns, field.field())
        };
        let ranks = FieldId::HASH.into_iter().chain(FieldId::others(0)).take(lanes).map(in_field);
        ranks
            .reduce(|best, rank| if rank.independent.len() > best.independent.len() { rank } else { best })
            .expect("there is a lane")
    }
}

/// Reduce equations in `unknowns` unknowns, one after the other.
fn rank(rows: Vec<Row>, unknowns: usize, f: &Field) -> Rank {
    let mut pivots: BTreeMap<usize, Reduced> = BTreeMap::new();
    let (mut independent, mut dependent) = (Vec::new(), Vec::new());
    for (equation, row) in rows.into_iter().enumerate() {
        let mut reduced = Reduced { row, combination: Row::from([(equation, f.one())]) };
        match reduce(&mut reduced, &pivots, unknowns, f) {
            Some(pivot) => {
                independent.push(equation);
                pivots.insert(pivot, reduced);
            }
            None => dependent.push(Dependent {
                equation,
                on: reduced.combination.keys().copied().filter(|&other| other != equation).collect(),
                contradicts: !reduced.row.is_empty(),
            }),
        }
    }
    let free = (0..unknowns).filter(|unknown| !pivots.contains_key(unknown)).collect();
    Rank { independent, dependent, free }
}

/// Subtract the known rows; return the first unknown that is left, if any.
fn reduce(
    reduced: &mut Reduced,
    pivots: &BTreeMap<usize, Reduced>,
    unknowns: usize,
    f: &Field,
) -> Option<usize> {
    loop {
        let (&leading, value) = reduced.row.first_key_value()?;
        if leading == unknowns {
            return None;
        }
        let Some(pivot) = pivots.get(&leading) else { return Some(leading) };
        let factor = f.neg(&f.div(value, &pivot.row[&leading]));
        add_multiple(&mut reduced.row, &pivot.row, &factor, f);
        add_multiple(&mut reduced.combination, &pivot.combination, &factor, f);
    }
}

fn add_multiple(row: &mut Row, other: &Row, factor: &Quadratic, f: &Field) {
    for (&position, value) in other {
        tick();
        let addend = f.mul(value, factor);
        let sum = row.get(&position).map_or_else(|| addend.clone(), |known| f.add(known, &addend));
        if sum.is_zero() {
            row.remove(&position);
        } else {
            row.insert(position, sum);
        }
    }
}
