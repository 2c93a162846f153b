"""Numbers: from equations of motion to motions, one or many, and to states of rest."""

from symbody.simulation.consistent import consistent_state
from symbody.simulation.equilibrium import Equilibrium, equilibrium
from symbody.simulation.event import Event, Occurrence
from symbody.simulation.grid import grid
from symbody.simulation.inverse_dynamics import InverseDynamics, inverse_dynamics
from symbody.simulation.many import simulate_many
from symbody.simulation.motion import Motion
from symbody.simulation.redundant_constraints import Redundancy, redundant_constraints
from symbody.simulation.runs import Runs
from symbody.simulation.simulate import simulate

__all__ = [
    "Equilibrium",
    "Event",
    "InverseDynamics",
    "Motion",
    "Occurrence",
    "Redundancy",
    "Runs",
    "consistent_state",
    "equilibrium",
    "grid",
    "inverse_dynamics",
    "redundant_constraints",
    "simulate",
    "simulate_many",
]
