//! The equations that are integrated: the rates of a state, its constraints and its events.

use crate::machine_code::{BoundCode, MachineCode};

/// Which zeros of a function are events, and whether they end the motion.
#[derive(Clone, Copy, Debug)]
pub struct EventKind {
    /// Positive: where the function rises through zero; negative: where it falls; zero: both.
    pub direction: i32,
    /// Whether the motion ends there.
    pub terminal: bool,
}

/// A system of equations as compiled code, for one set of parameters.
#[derive(Clone, Debug)]
pub struct Dynamics<F = BoundCode> {
    /// The rates of the state.
    pub rates: F,
    /// Its derivatives by the state that aren't identically zero, and their rows and columns.
    pub jacobian: Option<(F, Vec<(usize, usize)>)>,
    /// The change of the coordinates that leads onto the constraints, to first order: the coordinates come first.
    pub position_correction: Option<F>,
    /// The change of the speeds that leads onto the rates of the constraints: the speeds follow the coordinates.
    pub velocity_correction: Option<F>,
    /// The change of the sensitivities that leads onto the derivatives of the constraints, and their first place.
    pub sensitivity_correction: Option<(F, usize)>,
    /// The kinetic and the potential energy, where their balance can be watched.
    pub energies: Option<F>,
    /// The functions whose zeros are events, and the kind of each.
    pub events: Option<(F, Vec<EventKind>)>,
}

impl Dynamics<MachineCode> {
    /// The equations for the constants of one set of parameters, given function by function.
    pub fn with_constants(&self, constants: &[f64]) -> Dynamics {
        let mut rest = constants;
        let mut function = |code: &MachineCode| {
            let (own, others) = rest.split_at(code.constants());
            rest = others;
            BoundCode::new(*code, own)
        };
        Dynamics {
            rates: function(&self.rates),
            jacobian: self.jacobian.as_ref().map(|(code, places)| (function(code), places.clone())),
            position_correction: self.position_correction.as_ref().map(&mut function),
            velocity_correction: self.velocity_correction.as_ref().map(&mut function),
            sensitivity_correction: self
                .sensitivity_correction
                .as_ref()
                .map(|(code, first)| (function(code), *first)),
            energies: self.energies.as_ref().map(&mut function),
            events: self.events.as_ref().map(|(code, kinds)| (function(code), kinds.clone())),
        }
    }

    /// The number of constants that all functions read.
    pub fn constants(&self) -> usize {
        let jacobian = self.jacobian.as_ref().map(|(code, _)| code);
        let events = self.events.as_ref().map(|(code, _)| code);
        [
            Some(&self.rates),
            jacobian,
            self.position_correction.as_ref(),
            self.velocity_correction.as_ref(),
            self.sensitivity_correction.as_ref().map(|(code, _)| code),
            self.energies.as_ref(),
            events,
        ]
        .into_iter()
        .flatten()
        .map(MachineCode::constants)
        .sum()
    }
}
