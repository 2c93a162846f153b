//! The rank of a linear system, found in the finite field: the equations that are independent.
//!
//! Elimination of values costs nothing compared with elimination of expressions. It shows in advance which equations
//! depend on which others, and which unknowns stay free.

use std::collections::BTreeMap;

use crate::interrupt::tick;
use crate::value::Element;

/// An equation at the random point: unknowns by number, the constant under the number after the last.
pub(crate) type Row = BTreeMap<usize, Element>;

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
    combination: BTreeMap<usize, Element>,
}

/// Reduce equations in `unknowns` unknowns, one after the other.
pub(crate) fn rank(rows: Vec<Row>, unknowns: usize) -> Rank {
    let mut pivots: BTreeMap<usize, Reduced> = BTreeMap::new();
    let (mut independent, mut dependent) = (Vec::new(), Vec::new());
    for (equation, row) in rows.into_iter().enumerate() {
        let mut reduced = Reduced { row, combination: BTreeMap::from([(equation, Element::ONE)]) };
        match reduce(&mut reduced, &pivots, unknowns) {
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
fn reduce(reduced: &mut Reduced, pivots: &BTreeMap<usize, Reduced>, unknowns: usize) -> Option<usize> {
    loop {
        let (&leading, &value) = reduced.row.first_key_value()?;
        if leading == unknowns {
            return None;
        }
        let Some(pivot) = pivots.get(&leading) else { return Some(leading) };
        let factor = -(value * pivot.row[&leading].inverse());
        add_multiple(&mut reduced.row, &pivot.row, factor);
        add_multiple(&mut reduced.combination, &pivot.combination, factor);
    }
}

fn add_multiple(row: &mut BTreeMap<usize, Element>, other: &BTreeMap<usize, Element>, factor: Element) {
    for (&position, &value) in other {
        tick();
        let sum = row.get(&position).map_or(Element::ZERO, |&known| known) + value * factor;
        if sum.is_zero() {
            row.remove(&position);
        } else {
            row.insert(position, sum);
        }
    }
}
