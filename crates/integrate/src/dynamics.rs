//! The equations that are integrated: the rates of a state, its constraints and its events.

use crate::lane::Lane;
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

impl<F> Dynamics<F> {
    /// Whether there are constraints that are kept by corrections.
    pub fn has_constraints(&self) -> bool {
        self.position_correction.is_some() || self.velocity_correction.is_some()
    }
}

impl Dynamics<MachineCode> {
    /// The number of the rates among all functions.
    pub(crate) const RATES: usize = 0;
    /// The numbers of the corrections of positions and of velocities.
    pub(crate) const POSITIONS: usize = 2;
    pub(crate) const VELOCITIES: usize = 3;
    /// The number of the functions of the events.
    pub(crate) const EVENTS: usize = 6;

    /// All functions, each at its own number.
    pub(crate) fn functions(&self) -> [Option<&MachineCode>; 7] {
        [
            Some(&self.rates),
            self.jacobian.as_ref().map(|(code, _)| code),
            self.position_correction.as_ref(),
            self.velocity_correction.as_ref(),
            self.sensitivity_correction.as_ref().map(|(code, _)| code),
            self.energies.as_ref(),
            self.events.as_ref().map(|(code, _)| code),
        ]
    }

    /// The equations for the constants of one set of parameters, given function by function.
    pub fn with_constants(&self, constants: &[f64]) -> Dynamics {
        self.bound(constants, |code, own, _| BoundCode::new(*code, own))
    }

    /// The same equations, evaluated together with those of the other motions of a crew.
    pub(crate) fn in_lane(&self, constants: &[f64], lane: &Lane) -> Dynamics {
        self.bound(constants, |code, own, number| BoundCode::in_lane(*code, own, lane, number))
    }

    fn bound(&self, constants: &[f64], bind: impl Fn(&MachineCode, &[f64], usize) -> BoundCode) -> Dynamics {
        let mut rest = constants;
        let [rates, jacobian, position_correction, velocity_correction, slopes, energies, events] =
            self.functions();
        let mut numbers = 0..;
        let mut function = |code: Option<&MachineCode>| {
            let number = numbers.next();
            code.zip(number).map(|(code, number)| {
                let (own, others) = rest.split_at(code.constants());
                rest = others;
                bind(code, own, number)
            })
        };
        Dynamics {
            rates: function(rates).expect("the rates are always there"),
            jacobian: function(jacobian).zip(self.jacobian.as_ref().map(|(_, places)| places.clone())),
            position_correction: function(position_correction),
            velocity_correction: function(velocity_correction),
            sensitivity_correction: function(slopes)
                .zip(self.sensitivity_correction.as_ref().map(|(_, first)| *first)),
            energies: function(energies),
            events: function(events).zip(self.events.as_ref().map(|(_, kinds)| kinds.clone())),
        }
    }

    /// The number of constants that all functions read.
    pub fn constants(&self) -> usize {
        self.functions().into_iter().flatten().map(MachineCode::constants).sum()
    }
}
