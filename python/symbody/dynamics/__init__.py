"""Formalisms: from a system to its equations of motion."""

from .equations import Equations
from .euler import euler_equations
from .forward_dynamics import ForwardDynamics, dependent_speeds, forward_dynamics
from .generalized_force import generalized_force
from .lagrange import lagrange, lagrange_equations
from .newton import newton_equations
from .newton_euler import newton_euler
from .program import program

__all__ = [
    "Equations",
    "ForwardDynamics",
    "dependent_speeds",
    "euler_equations",
    "forward_dynamics",
    "generalized_force",
    "lagrange",
    "lagrange_equations",
    "newton_equations",
    "newton_euler",
    "program",
]
