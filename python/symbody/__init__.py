"""symbody: symbolic equations of motion of multibody systems, derived, checked, and solved numerically.

This module has the public names of all layers: ``import symbody as sb``. The layers that turn equations into code and
numbers are loaded when one of their names is first used, because SciPy and LLVM take long to load.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

from symbody.dynamics import (
    CanonicalEquations,
    Equations,
    ForwardDynamics,
    dependent_speeds,
    embedded,
    equations_of,
    euler_equations,
    forward_dynamics,
    generalized_force,
    gibbs_appell,
    hamilton,
    kane,
    lagrange,
    lagrange_equations,
    newton_equations,
    newton_euler,
)
from symbody.dynamics.equations.independence import register_adviser
from symbody.errors import ModelNotice, SymbodyError
from symbody.geometry import (
    Frame,
    Point,
    Vector,
    acceleration,
    angular_velocity,
    cross,
    dot,
    floating_frame,
    frozen_velocity,
    ground,
    moving_frame,
    origin,
    project,
    rotate,
    translate,
    velocity,
)
from symbody.multibody import (
    Body,
    Constraint,
    Element,
    Force,
    System,
    Torque,
    angular_momentum,
    center_of_mass,
    describe,
    gravitational_energy,
    kinetic_energy,
    line_force,
    linear_momentum,
    mechanical_energy,
    potential_energy,
    power,
    show,
    spring,
)
from symbody.symbolic import (
    Abs,
    Cost,
    Expr,
    Matrix,
    Max,
    Min,
    Piecewise,
    UndefinedFunction,
    acos,
    asin,
    atan,
    atan2,
    coeff,
    collect,
    combine_trig,
    cos,
    cosh,
    cost,
    current_derivation,
    derivation,
    diff,
    exp,
    expand,
    expand_trig,
    factor_terms,
    from_sympy,
    function,
    functions_of_time,
    gradient,
    identity,
    jacobian,
    latex,
    ldl_solve,
    linear_solve,
    listing,
    log,
    maple,
    number,
    parse,
    partial_derivative,
    pi,
    readable,
    sign,
    simplify,
    sin,
    sinh,
    solve,
    sqrt,
    subs,
    substitute,
    symbols,
    t,
    tan,
    tanh,
    time_derivative,
    time_derivatives,
    to_sympy,
    zeros,
)
from symbody.symbolic.given.hint import no_attribute

if TYPE_CHECKING:
    from symbody.codegen import CompiledFunction, MachineCode, generate, lambdify
    from symbody.document import report
    from symbody.simulation import (
        Equilibrium,
        Event,
        InverseDynamics,
        Mobility,
        Motion,
        Occurrence,
        Redundancy,
        Runs,
        consistent_state,
        equilibrium,
        grid,
        inverse_dynamics,
        mobility,
        redundant_constraints,
        simulate,
        simulate_many,
    )

    __version__: str


__all__ = [
    "Abs",
    "Body",
    "CanonicalEquations",
    "CompiledFunction",
    "Constraint",
    "Cost",
    "Element",
    "Equations",
    "Equilibrium",
    "Event",
    "Expr",
    "Force",
    "ForwardDynamics",
    "Frame",
    "InverseDynamics",
    "MachineCode",
    "Matrix",
    "Max",
    "Min",
    "Mobility",
    "ModelNotice",
    "Motion",
    "Occurrence",
    "Piecewise",
    "Point",
    "Redundancy",
    "Runs",
    "SymbodyError",
    "System",
    "Torque",
    "UndefinedFunction",
    "Vector",
    "acceleration",
    "acos",
    "angular_momentum",
    "angular_velocity",
    "asin",
    "atan",
    "atan2",
    "center_of_mass",
    "coeff",
    "collect",
    "combine_trig",
    "consistent_state",
    "cos",
    "cosh",
    "cost",
    "cross",
    "current_derivation",
    "dependent_speeds",
    "derivation",
    "describe",
    "diff",
    "dot",
    "embedded",
    "equations_of",
    "equilibrium",
    "euler_equations",
    "exp",
    "expand",
    "expand_trig",
    "factor_terms",
    "floating_frame",
    "forward_dynamics",
    "from_sympy",
    "frozen_velocity",
    "function",
    "functions_of_time",
    "generalized_force",
    "generate",
    "gibbs_appell",
    "gradient",
    "gravitational_energy",
    "grid",
    "ground",
    "hamilton",
    "identity",
    "inverse_dynamics",
    "jacobian",
    "kane",
    "kinetic_energy",
    "lagrange",
    "lagrange_equations",
    "lambdify",
    "latex",
    "ldl_solve",
    "line_force",
    "linear_momentum",
    "linear_solve",
    "listing",
    "log",
    "maple",
    "mechanical_energy",
    "mobility",
    "moving_frame",
    "newton_equations",
    "newton_euler",
    "number",
    "origin",
    "parse",
    "partial_derivative",
    "pi",
    "potential_energy",
    "power",
    "project",
    "readable",
    "redundant_constraints",
    "report",
    "rotate",
    "show",
    "sign",
    "simplify",
    "simulate",
    "simulate_many",
    "sin",
    "sinh",
    "solve",
    "spring",
    "sqrt",
    "subs",
    "substitute",
    "symbols",
    "t",
    "tan",
    "tanh",
    "time_derivative",
    "time_derivatives",
    "to_sympy",
    "translate",
    "velocity",
    "zeros",
]

_LATER = ("codegen", "simulation", "view", "document")
"""The layers that are loaded when one of their names is first used, the lower ones first."""


def _what_is_redundant(system: object) -> str:
    text: str = import_module("symbody.simulation.constraint.redundant_constraints").advice(system)
    return text


register_adviser(_what_is_redundant)

if not TYPE_CHECKING:  # for type checkers, a module with this function has every name

    def __getattr__(name: str) -> object:
        """Load the layer of a public name when it is first used [PEP 562]."""
        if name in _LATER:
            return import_module(f"symbody.{name}")
        if name == "__version__":
            value = import_module("importlib.metadata").version("symbody")
        elif name in __all__:
            layers = (import_module(f"symbody.{layer}") for layer in _LATER)
            value = next(getattr(layer, name) for layer in layers if name in layer.__all__)
        else:
            raise no_attribute("symbody", name)
        globals()[name] = value
        return value


def __dir__() -> list[str]:
    """List the public names, loaded or not."""
    return sorted({*globals(), *__all__, *_LATER, "__version__"})
