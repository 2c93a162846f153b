//! Linear systems of deficient rank that are found at run time.

use std::collections::BTreeSet;

use super::contradiction::{Contradiction, contradictions};
use super::factorization::dependent;

/// A linear system without a unique solution.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Deficiency {
    /// The number of the system among those of the code.
    pub system: u32,
    /// The number of equations.
    pub equations: usize,
    /// The equations that follow from the others.
    pub dependent: Vec<usize>,
    /// The equations that contradict others.
    pub contradictions: Vec<Contradiction>,
}

impl Deficiency {
    /// The deficiency of a system with this right side, from the factorisation in the workspace; `None` if its rank is
    /// full.
    #[must_use]
    pub fn of(system: u32, n: usize, work: &[f64], right: &[f64]) -> Option<Self> {
        let named: Vec<usize> = dependent(n, work).collect();
        if named.is_empty() {
            return None;
        }
        let contradictions = contradictions(n, work, right);
        let against: BTreeSet<usize> = contradictions.iter().map(|found| found.equation).collect();
        let dependent = named.into_iter().filter(|row| !against.contains(row)).collect();
        Some(Self { system, equations: n, dependent, contradictions })
    }
}
