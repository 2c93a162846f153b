"""Expressions: values first, forms second."""

from symbody.symbolic._core import Expr
from symbody.symbolic.calculus import (
    diff,
    gradient,
    jacobian,
    subs,
    substitute,
    time_derivative,
    time_derivatives,
)
from symbody.symbolic.cost import Cost, cost
from symbody.symbolic.derivation import Derivation, current_derivation, derivation
from symbody.symbolic.functions import (
    Abs,
    Max,
    Min,
    Piecewise,
    acos,
    asin,
    atan,
    atan2,
    cos,
    cosh,
    exp,
    log,
    sign,
    sin,
    sinh,
    sqrt,
    tan,
    tanh,
)
from symbody.symbolic.lambdify import CompiledFunction, lambdify
from symbody.symbolic.leaves import (
    ExprLike,
    UndefinedFunction,
    function,
    functions_of_time,
    number,
    pi,
    symbol,
    symbols,
    t,
)
from symbody.symbolic.matrix import Matrix, identity, zeros
from symbody.symbolic.parse import parse
from symbody.symbolic.printing import latex, listing, maple
from symbody.symbolic.sympy_bridge import from_sympy, to_sympy
from symbody.symbolic.triple import (
    add3,
    cross3,
    dot3,
    matvec3,
    matvec3_transposed,
    rotate3,
    rotate_back3,
    scale3,
    sub3,
)
