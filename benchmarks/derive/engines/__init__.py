"""What symbody is measured against, and symbody itself: one file a system, `base` is what they share."""

from .base import Algebra, Engine, Expression
from .casadi import CasADi
from .symbody import Symbody
from .symengine import SymEngine
from .sympy import SymPy

CASADI = CasADi()
SYMBODY = Symbody()
SYMENGINE = SymEngine()
SYMPY = SymPy()

ENGINES: tuple[Engine, ...] = (SYMBODY, SYMPY, SYMENGINE, CASADI)

__all__ = ["CASADI", "ENGINES", "SYMBODY", "SYMENGINE", "SYMPY", "Algebra", "Engine", "Expression"]
