//! The balance of energy along a motion: the energy of the state minus the work done is constant except for errors.

use crate::dynamics::Dynamics;
use crate::machine_code::BoundCode;
use crate::thinned::Thinned;
use crate::tolerances::Tolerances;

/// The number of steps between two checks of the energy, and of checks between two updates of the effect of errors.
pub const LOOK: (usize, usize) = (4, 8);
/// A safety factor on the imbalance that the errors of the steps explain, because these are estimates.
const MARGIN: f64 = 10.0;
/// The fraction of the energies that rounding errors may change.
const ROUNDING: f64 = 1e-11;
/// A loss of more than this fraction of the energy that changes, or of this many relative tolerances, is always
/// reported: errors may explain it, but the motion is wrong.
const MOST: (f64, f64) = (0.01, 200.0);

/// A violation of the balance of energy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Imbalance {
    /// The instant when it first exceeded what the errors of the steps explain.
    pub t: f64,
    /// The largest violation, relative to the largest of the kinetic energy, the change of the potential energy, and
    /// the work.
    pub part: f64,
}

/// Watches the balance of energy.
pub struct Balance<'a> {
    /// The kinetic and the potential energy.
    energies: Option<&'a BoundCode>,
    tolerances: Tolerances,
    /// Their sum at the start, minus the work.
    first: f64,
    first_potential: f64,
    /// The largest energy that changes, and the largest of all energies.
    moving: f64,
    largest: f64,
    /// The largest change of the energy by errors of one tolerance in each entry of the state.
    spread: f64,
    /// The changes by errors of one absolute tolerance.
    spreads: Thinned<f64>,
    /// How many states were checked.
    checked: usize,
    /// The largest violation of the balance so far.
    most: f64,
    /// The instants of violations that were larger than all before, and these violations.
    records: Thinned<(f64, f64)>,
    /// Instants and states whose energies are not evaluated yet, one after another: several at a time are quicker.
    pending: Vec<f64>,
}

impl<'a> Balance<'a> {
    pub fn new(dynamics: &'a Dynamics, tolerances: Tolerances, t: f64, state: &[f64]) -> Self {
        let pending = if dynamics.energies.is_some() { LOOK.1 * (1 + state.len()) } else { 0 };
        let mut new = Self {
            energies: dynamics.energies.as_ref(),
            tolerances,
            first: 0.0,
            first_potential: 0.0,
            moving: 0.0,
            largest: 0.0,
            spread: 0.0,
            spreads: Thinned::new(),
            checked: 0,
            most: 0.0,
            records: Thinned::new(),
            pending: Vec::with_capacity(pending),
        };
        new.look(t, state);
        if let Some([kinetic, potential]) = finite(&new.energies_of(&new.pending)) {
            new.first = kinetic + potential - new.work(state);
            new.first_potential = potential;
        }
        new
    }

    /// Check the balance after a step, at every few steps.
    pub fn watch(&mut self, step: usize, t: f64, state: &[f64]) {
        if step.is_multiple_of(LOOK.0) {
            self.look(t, state);
        }
    }

    fn look(&mut self, t: f64, state: &[f64]) {
        if self.energies.is_none() {
            return;
        }
        self.pending.push(t);
        self.pending.extend_from_slice(state);
        if self.pending.len() == LOOK.1 * (1 + state.len()) {
            self.evaluate(state.len());
        }
    }

    /// Check the balance at the pending states.
    fn evaluate(&mut self, width: usize) {
        let rows = std::mem::take(&mut self.pending);
        let values = self.energies_of(&rows);
        for (row, energies) in rows.chunks(1 + width).zip(values.chunks(2)) {
            let (t, state) = (row[0], &row[1..]);
            let Some([kinetic, potential]) = finite(energies) else { continue };
            let work = self.work(state);
            for energy in [kinetic, potential - self.first_potential, work] {
                self.moving = self.moving.max(energy.abs());
            }
            self.largest = self.largest.max(kinetic.abs() + potential.abs());
            if self.checked.is_multiple_of(LOOK.1) {
                self.widen(t, state, kinetic + potential);
            }
            self.checked += 1;
            let off = (kinetic + potential - work - self.first).abs();
            if off > self.most {
                self.most = off;
                self.records.push((t, off));
            }
        }
        self.pending = rows;
        self.pending.clear();
    }

    /// The violation until the end of a motion, if it exceeds what the errors of its steps explain. Their sum is in
    /// tolerances.
    pub fn imbalance(&mut self, t: f64, state: &[f64], errors: f64) -> Option<Imbalance> {
        self.look(t, state);
        self.evaluate(state.len());
        let [kinetic, potential] = self.at(t, state)?;
        self.widen(t, state, kinetic + potential);
        // Work and energies of springs are integrals, so their errors are those of the energy that changes.
        let Tolerances { relative, absolute, .. } = self.tolerances;
        let by_work = if self.has_work(state) { absolute } else { 0.0 };
        let each = self.spread.max(by_work).max(relative * self.moving);
        // Motions as small as the absolute tolerances may lose all of the energy that changes. The median leaves out a
        // short time of large accelerations, at which one tolerance would be much energy.
        let least = self.usual_spread() + by_work;
        let most = MOST.0.max(MOST.1 * relative) * self.moving + MARGIN * least;
        let explained = (MARGIN * (1.0 + errors) * each).min(most) + ROUNDING * self.largest;
        if self.most <= explained {
            return None;
        }
        let first = self.records.kept().iter().find(|(_, off)| *off > explained);
        // The largest of all is thinned out of a very long motion if it came last.
        let t = first.map_or(t, |(t, _)| *t);
        Some(Imbalance { t, part: self.most / self.moving.max(f64::MIN_POSITIVE) })
    }

    /// The work, if there is any, is the entry after those that are controlled.
    fn work(&self, state: &[f64]) -> f64 {
        state.get(self.tolerances.controlled).copied().unwrap_or(0.0)
    }

    fn has_work(&self, state: &[f64]) -> bool {
        state.len() > self.tolerances.controlled
    }

    fn at(&self, t: f64, state: &[f64]) -> Option<[f64; 2]> {
        let row: Vec<f64> = std::iter::once(t).chain(state.iter().copied()).collect();
        finite(&self.energies_of(&row))
    }

    /// The energies at states, two for each: rows of an instant and a state.
    fn energies_of(&self, rows: &[f64]) -> Vec<f64> {
        let Some(code) = self.energies.filter(|_| !rows.is_empty()) else { return Vec::new() };
        let mut values = vec![0.0; rows.len() / code.inputs() * 2];
        code.call_rows(rows, &mut values);
        values
    }

    /// Update the changes of the energy by errors of one tolerance in each entry.
    fn widen(&mut self, t: f64, state: &[f64], energy: f64) {
        let Tolerances { relative, absolute, controlled, .. } = self.tolerances;
        let mut rows = Vec::with_capacity(2 * controlled * (1 + state.len()));
        for relative in [relative, 0.0] {
            for i in 0..controlled {
                let row = rows.len() + 1;
                rows.push(t);
                rows.extend_from_slice(state);
                rows[row + i] = state[i] + (absolute + relative * state[i].abs());
            }
        }
        let changes: Vec<f64> = self
            .energies_of(&rows)
            .chunks(2)
            .map(|near| finite(near).map_or(0.0, |[kinetic, potential]| (kinetic + potential - energy).abs()))
            .collect();
        let sum = |changes: &[f64]| changes.iter().fold(0.0, |sum, change| sum + change);
        let (both, least) = changes.split_at(changes.len() / 2);
        self.spread = self.spread.max(sum(both));
        self.spreads.push(sum(least));
    }

    /// The median of the changes by errors of one absolute tolerance.
    fn usual_spread(&self) -> f64 {
        let mut spreads = self.spreads.kept().to_vec();
        spreads.sort_by(f64::total_cmp);
        spreads.get(spreads.len() / 2).copied().unwrap_or(0.0)
    }
}

/// The kinetic and the potential energy of a state, if they are finite.
fn finite(energies: &[f64]) -> Option<[f64; 2]> {
    match *energies {
        [kinetic, potential] if kinetic.is_finite() && potential.is_finite() => Some([kinetic, potential]),
        _ => None,
    }
}
