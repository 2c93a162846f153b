"""Numerical results from equations of motion: motions, one or many, equilibria, and inverse dynamics."""

from symbody.simulation.batch.grid import grid
from symbody.simulation.batch.many import simulate_many
from symbody.simulation.batch.runs import Runs
from symbody.simulation.constraint.consistent import consistent_state
from symbody.simulation.constraint.mobility import Mobility, mobility
from symbody.simulation.constraint.redundant_constraints import Redundancy, redundant_constraints
from symbody.simulation.given.event import Event
from symbody.simulation.given.stop import stops
from symbody.simulation.inverse.inverse_dynamics import InverseDynamics, inverse_dynamics
from symbody.simulation.motion.motion import Motion
from symbody.simulation.motion.occurrence import Occurrence
from symbody.simulation.motion.simulate import simulate
from symbody.simulation.statics.equilibrium import Equilibrium, equilibrium

__all__ = [
    "Equilibrium",
    "Event",
    "InverseDynamics",
    "Mobility",
    "Motion",
    "Occurrence",
    "Redundancy",
    "Runs",
    "consistent_state",
    "equilibrium",
    "grid",
    "inverse_dynamics",
    "mobility",
    "redundant_constraints",
    "simulate",
    "simulate_many",
    "stops",
]
