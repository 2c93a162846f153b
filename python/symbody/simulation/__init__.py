"""Numerical results from equations of motion: motions, one or many, equilibria, and inverse dynamics."""

from symbody.simulation.batch.grid import grid
from symbody.simulation.batch.many import simulate_many
from symbody.simulation.batch.runs import Runs
from symbody.simulation.constraint.consistent import consistent_state
from symbody.simulation.constraint.mobility import Mobility, mobility
from symbody.simulation.constraint.redundant_constraints import Redundancy, redundant_constraints
from symbody.simulation.given.event import Event
from symbody.simulation.given.stop import stops
from symbody.simulation.given.time_history import time_histories, time_history
from symbody.simulation.inverse.inverse_dynamics import InverseDynamics, inverse_dynamics
from symbody.simulation.linear.critical_value import CriticalValue
from symbody.simulation.linear.frequency_response import FrequencyResponse, frequency_response
from symbody.simulation.linear.matrices import StateSpace, state_space
from symbody.simulation.linear.mode import Mode
from symbody.simulation.linear.modes import Modes, modes
from symbody.simulation.linear.root_locus import RootLocus, root_locus
from symbody.simulation.linear.sweep import Sweep, sweep
from symbody.simulation.linear.time_response import TimeResponse, impulse_response, step_response
from symbody.simulation.motion.motion import Motion
from symbody.simulation.motion.occurrence import Occurrence
from symbody.simulation.motion.simulate import simulate
from symbody.simulation.sensitivity.gradient_of_motion import MotionGradient, gradient_of_motion
from symbody.simulation.steady_state.branch import Branch
from symbody.simulation.steady_state.branch_switching import crossing_branch
from symbody.simulation.steady_state.continuation import continuation
from symbody.simulation.steady_state.equilibrium import Equilibrium, equilibrium
from symbody.simulation.steady_state.steady import steady
from symbody.simulation.steady_state.steady_motion import SteadyMotion
from symbody.simulation.steady_state.steady_motions import steady_motions
from symbody.simulation.studies import measures, statistics
from symbody.simulation.studies.fit.experiment import Experiment, Measurement
from symbody.simulation.studies.fit.fit import fit
from symbody.simulation.studies.fit.fitted import Fit
from symbody.simulation.studies.sample.lazy_sample import LazySample
from symbody.simulation.studies.sample.sample import sample
from symbody.simulation.studies.sobol_indices import SobolIndices, sobol_indices
from symbody.simulation.studies.study import study
from symbody.simulation.studies.study_results import Study

__all__ = [
    "Branch",
    "CriticalValue",
    "Equilibrium",
    "Event",
    "Experiment",
    "Fit",
    "FrequencyResponse",
    "InverseDynamics",
    "LazySample",
    "Measurement",
    "Mobility",
    "Mode",
    "Modes",
    "Motion",
    "MotionGradient",
    "Occurrence",
    "Redundancy",
    "RootLocus",
    "Runs",
    "SobolIndices",
    "StateSpace",
    "SteadyMotion",
    "Study",
    "Sweep",
    "TimeResponse",
    "consistent_state",
    "continuation",
    "crossing_branch",
    "equilibrium",
    "fit",
    "frequency_response",
    "gradient_of_motion",
    "grid",
    "impulse_response",
    "inverse_dynamics",
    "measures",
    "mobility",
    "modes",
    "redundant_constraints",
    "root_locus",
    "sample",
    "simulate",
    "simulate_many",
    "sobol_indices",
    "state_space",
    "statistics",
    "steady",
    "steady_motions",
    "step_response",
    "stops",
    "study",
    "sweep",
    "time_histories",
    "time_history",
]
