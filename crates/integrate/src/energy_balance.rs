//! The balance of energy along a motion: the energy of the state minus the work done is constant except for errors.

use crate::dynamics::Dynamics;
use crate::machine_code::BoundCode;
use crate::tolerances::Tolerances;

/// The number of steps between two checks of the energy, and of checks between two updates of the effect of errors.
const LOOK: (usize, usize) = (4, 8);
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
    spreads: Vec<f64>,
    /// The violations of the balance, and their instants.
    seen: Vec<(f64, f64)>,
}

impl<'a> Balance<'a> {
    pub fn new(dynamics: &'a Dynamics, tolerances: Tolerances, t: f64, state: &[f64]) -> Self {
        let mut new = Self {
            energies: dynamics.energies.as_ref(),
            tolerances,
            first: 0.0,
            first_potential: 0.0,
            moving: 0.0,
            largest: 0.0,
            spread: 0.0,
            spreads: Vec::new(),
            seen: Vec::new(),
        };
        if let Some([kinetic, potential]) = new.at(t, state) {
            new.first = kinetic + potential - new.work(state);
            new.first_potential = potential;
        }
        new.look(t, state);
        new
    }

    /// Check the balance after a step, at every few steps.
    pub fn watch(&mut self, step: usize, t: f64, state: &[f64]) {
        if step % LOOK.0 == 0 {
            self.look(t, state);
        }
    }

    fn look(&mut self, t: f64, state: &[f64]) {
        let Some([kinetic, potential]) = self.at(t, state) else { return };
        let work = self.work(state);
        for energy in [kinetic, potential - self.first_potential, work] {
            self.moving = self.moving.max(energy.abs());
        }
        self.largest = self.largest.max(kinetic.abs() + potential.abs());
        if self.seen.len() % LOOK.1 == 0 {
            self.widen(t, state, kinetic + potential);
        }
        self.seen.push((t, (kinetic + potential - work - self.first).abs()));
    }

    /// The violation until the end of a motion, if it exceeds what the errors of its steps explain. Their sum is in
    /// tolerances.
    pub fn imbalance(&mut self, t: f64, state: &[f64], errors: f64) -> Option<Imbalance> {
        self.look(t, state);
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
        let &(t, _) = self.seen.iter().find(|(_, off)| *off > explained)?;
        let most = self.seen.iter().fold(0.0, |most: f64, (_, off)| most.max(*off));
        Some(Imbalance { t, part: most / self.moving.max(f64::MIN_POSITIVE) })
    }

    /// The work, if there is any, is the entry after those that are controlled.
    fn work(&self, state: &[f64]) -> f64 {
        state.get(self.tolerances.controlled).copied().unwrap_or(0.0)
    }

    fn has_work(&self, state: &[f64]) -> bool {
        state.len() > self.tolerances.controlled
    }

    fn at(&self, t: f64, state: &[f64]) -> Option<[f64; 2]> {
        let mut energies = [0.0; 2];
        self.energies?.call(t, state, &mut energies);
        energies.iter().all(|energy| energy.is_finite()).then_some(energies)
    }

    /// Update the changes of the energy by errors of one tolerance in each entry.
    fn widen(&mut self, t: f64, state: &[f64], energy: f64) {
        let Tolerances { relative, absolute, .. } = self.tolerances;
        let both = self.changed(t, state, energy, |x| absolute + relative * x.abs());
        self.spread = self.spread.max(both);
        self.spreads.push(self.changed(t, state, energy, |_| absolute));
    }

    /// The median of the changes by errors of one absolute tolerance.
    fn usual_spread(&mut self) -> f64 {
        self.spreads.sort_by(f64::total_cmp);
        self.spreads.get(self.spreads.len() / 2).copied().unwrap_or(0.0)
    }

    /// The sum of the changes of the energy by an error in each entry.
    fn changed(&self, t: f64, state: &[f64], energy: f64, error: impl Fn(f64) -> f64) -> f64 {
        let mut near = state.to_vec();
        let mut sum = 0.0;
        for i in 0..self.tolerances.controlled {
            near[i] = state[i] + error(state[i]);
            let changed = self.at(t, &near);
            sum += changed.map_or(0.0, |[kinetic, potential]| (kinetic + potential - energy).abs());
            near[i] = state[i];
        }
        sum
    }
}
