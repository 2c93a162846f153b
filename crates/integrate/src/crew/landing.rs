//! States of all lanes, put onto the constraints at once by the corrections of a motion alone: the ends of accepted
//! steps, and states within them.
//!
//! Where a correction is too large or does not converge, the motion takes the step itself, since it knows ways out.

use std::ops::Range;

use crate::branch::{TOLERANCES, bound};
use crate::projection::{ITERATIONS, LARGE, SMALL};
use crate::tolerances::Tolerances;

use super::columns::{Columns, Waiting};
use super::stages::StepColumns;
use super::vectors::{Loop, blend, in_vectors};

/// The changes that lead onto the constraints, to first order: of the coordinates, and of the speeds.
pub(super) struct Corrections<'a, const W: usize> {
    pub positions: Option<&'a mut Columns<W>>,
    pub velocities: Option<&'a mut Columns<W>>,
}

/// The states at the ends of the steps.
pub(super) struct Landings<const W: usize> {
    tolerances: Tolerances,
    coordinates: usize,
    speeds: Range<usize>,
    /// The states on the constraints.
    pub states: Vec<[f64; W]>,
    /// The largest speeds at both ends of the steps.
    pub fastest: [f64; W],
    /// The largest changes of a speed that corrections within these steps may make.
    pub bounds: [f64; W],
}

/// Some lanes, the instants of their states, and the largest changes of a speed that corrections may make.
#[derive(Clone, Copy)]
pub(super) struct Chosen<'a, const W: usize> {
    pub lanes: &'a [bool; W],
    pub instants: &'a [f64; W],
    pub bounds: &'a [f64; W],
}

impl<const W: usize> Landings<W> {
    pub fn new(tolerances: Tolerances, (coordinates, speeds): (usize, usize), entries: usize) -> Self {
        let speeds = coordinates..coordinates + speeds;
        let states = vec![[0.0; W]; entries];
        Self { tolerances, coordinates, speeds, states, fastest: [0.0; W], bounds: [0.0; W] }
    }

    /// The places of the speeds in a state.
    pub fn speeds(&self) -> Range<usize> {
        self.speeds.clone()
    }

    /// The largest speeds of some states.
    pub fn fastest_of(&self, states: &[[f64; W]]) -> [f64; W] {
        let mut fastest = [0.0; W];
        in_vectors::<W>(Fastest { states: &states[self.speeds.clone()], out: &mut fastest });
        fastest
    }

    /// Put the ends of accepted steps, at these instants, onto the constraints; return where that is done. The largest
    /// speeds are those of the motions so far.
    pub fn land(
        &mut self,
        (accepted, ends, largest): (&[bool; W], &[f64; W], &[f64; W]),
        step: &StepColumns<W>,
        corrections: &mut Corrections<'_, W>,
        waiting: &mut Waiting<'_, W>,
    ) -> [bool; W] {
        let (before, after) = (self.fastest_of(&step.before), self.fastest_of(&step.after));
        self.fastest = std::array::from_fn(|lane| before[lane].max(after[lane]));
        self.bounds = std::array::from_fn(|lane| {
            let here = self.fastest[lane];
            bound(&self.tolerances, TOLERANCES.0, largest[lane].max(here), here)
        });
        let mut states = std::mem::take(&mut self.states);
        states.copy_from_slice(&step.after);
        let chosen = Chosen { lanes: accepted, instants: ends, bounds: &self.bounds };
        let landed = self.project(&mut states, chosen, corrections, waiting);
        self.states = states;
        landed
    }

    /// Put states of some lanes onto the constraints; return where that is done.
    pub fn project(
        &self,
        states: &mut [[f64; W]],
        chosen: Chosen<'_, W>,
        corrections: &mut Corrections<'_, W>,
        waiting: &mut Waiting<'_, W>,
    ) -> [bool; W] {
        let mut landed = *chosen.lanes;
        if let Some(positions) = &mut corrections.positions {
            self.close(states, &mut landed, chosen.instants, positions, waiting);
        }
        if let Some(velocities) = &mut corrections.velocities {
            let to = (&landed, chosen.instants, self.speeds.clone());
            let changes = correct(states, to, velocities, waiting);
            for (landed, (size, most)) in landed.iter_mut().zip(changes.sizes.iter().zip(chosen.bounds)) {
                *landed &= size <= most;
            }
        }
        landed
    }

    /// Correct the coordinates until they satisfy the constraints.
    fn close(
        &self,
        states: &mut [[f64; W]],
        landed: &mut [bool; W],
        instants: &[f64; W],
        positions: &mut Columns<W>,
        waiting: &mut Waiting<'_, W>,
    ) {
        let (mut goes_on, mut sizes) = (*landed, [f64::INFINITY; W]);
        for _ in 0..ITERATIONS {
            let to = (&goes_on, instants, 0..self.coordinates);
            let changes = correct(states, to, positions, waiting);
            for lane in (0..W).filter(|&lane| goes_on[lane]) {
                sizes[lane] = changes.sizes[lane] / changes.scales[lane];
            }
            // NaN is an end, too.
            goes_on = std::array::from_fn(|lane| goes_on[lane] && sizes[lane] > SMALL);
            if !goes_on.contains(&true) {
                break;
            }
        }
        for (landed, size) in landed.iter_mut().zip(sizes) {
            *landed &= size <= LARGE;
        }
    }
}

/// Add a correction to some entries of the states of some lanes, at these instants.
fn correct<const W: usize>(
    states: &mut [[f64; W]],
    (chosen, instants, entries): (&[bool; W], &[f64; W], Range<usize>),
    correction: &mut Columns<W>,
    waiting: &mut Waiting<'_, W>,
) -> Changes<W> {
    correction.inputs[0] = *instants;
    correction.inputs[1..=states.len()].copy_from_slice(states);
    correction.evaluate(&mut Waiting { lanes: *chosen, noted: &mut *waiting.noted });
    let mut changes = Changes { sizes: [0.0; W], scales: [1.0; W] };
    let (states, by) = (&mut states[entries], &correction.outputs);
    in_vectors::<W>(Application { states, by, chosen, changes: &mut changes });
    changes
}

/// The largest changes of an entry, NaN if one is not finite, and the largest entries, at least 1.
struct Changes<const W: usize> {
    sizes: [f64; W],
    scales: [f64; W],
}

struct Application<'a, const W: usize> {
    states: &'a mut [[f64; W]],
    by: &'a [[f64; W]],
    chosen: &'a [bool; W],
    changes: &'a mut Changes<W>,
}

impl<const W: usize> Loop for Application<'_, W> {
    #[allow(clippy::inline_always, reason = "what isn't inlined there isn't compiled for those vectors")]
    #[inline(always)]
    fn run(self) {
        let (mut sizes, mut scales, mut zeros) = ([0.0_f64; W], [1.0_f64; W], [0.0; W]);
        for (x, change) in self.states.iter_mut().zip(self.by) {
            let (mut sum, change) = (*x, *change);
            for lane in 0..W {
                sum[lane] += change[lane];
                sizes[lane] = sizes[lane].max(change[lane].abs());
                scales[lane] = scales[lane].max(sum[lane].abs());
                zeros[lane] += 0.0 * change[lane];
            }
            blend(x, &sum, self.chosen);
        }
        for lane in 0..W {
            sizes[lane] += zeros[lane];
        }
        *self.changes = Changes { sizes, scales };
    }
}

struct Fastest<'a, const W: usize> {
    states: &'a [[f64; W]],
    out: &'a mut [f64; W],
}

impl<const W: usize> Loop for Fastest<'_, W> {
    #[allow(clippy::inline_always, reason = "what isn't inlined there isn't compiled for those vectors")]
    #[inline(always)]
    fn run(self) {
        let mut fastest = [0.0_f64; W];
        for speeds in self.states {
            for lane in 0..W {
                fastest[lane] = fastest[lane].max(speeds[lane].abs());
            }
        }
        *self.out = fastest;
    }
}
