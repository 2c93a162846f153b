"""Dynamics: from a system to its equations of motion, and to what solves them."""

from symbody.dynamics.equations import of_sympy as _of_sympy  # noqa: F401  enters the converters
from symbody.dynamics.equations.canonical import CanonicalEquations
from symbody.dynamics.equations.equations import Equations
from symbody.dynamics.equations.equations_of import equations_of
from symbody.dynamics.equations.from_differential import equations_from_differential
from symbody.dynamics.formalism.euler import euler_equations
from symbody.dynamics.formalism.generalized_force import generalized_force
from symbody.dynamics.formalism.gibbs_appell import gibbs_appell
from symbody.dynamics.formalism.hamilton import hamilton
from symbody.dynamics.formalism.held import Reaction
from symbody.dynamics.formalism.kane import kane
from symbody.dynamics.formalism.lagrange import lagrange, lagrange_equations
from symbody.dynamics.formalism.newton import newton_equations
from symbody.dynamics.formalism.newton_euler import newton_euler
from symbody.dynamics.formalism.reaction import reaction
from symbody.dynamics.linearization import linear_program as _linear_program  # noqa: F401  enters the programs
from symbody.dynamics.linearization.linear import Linear
from symbody.dynamics.linearization.linearize import linearize
from symbody.dynamics.solution.dependent_speeds import dependent_speeds
from symbody.dynamics.solution.embedded import embedded
from symbody.dynamics.solution.equations_program import program
from symbody.dynamics.solution.forward_dynamics import ForwardDynamics, forward_dynamics

__all__ = [
    "CanonicalEquations",
    "Equations",
    "ForwardDynamics",
    "Linear",
    "Reaction",
    "dependent_speeds",
    "embedded",
    "equations_from_differential",
    "equations_of",
    "euler_equations",
    "forward_dynamics",
    "generalized_force",
    "gibbs_appell",
    "hamilton",
    "kane",
    "lagrange",
    "lagrange_equations",
    "linearize",
    "newton_equations",
    "newton_euler",
    "program",
    "reaction",
]
