"""Hints for users of SymPy, NumPy and MBSymba, who look for a name that is different here."""

from __future__ import annotations

from collections.abc import Mapping

__all__ = ["no_attribute"]

_SYMBOLS = "symbols('x y')"
_NUMBER = "number('1/2'), exactly"
_SYSTEM = "System(bodies, loads, coordinates)"

_MODULE = {
    "Symbol": _SYMBOLS,
    "symbol": _SYMBOLS,
    "var": _SYMBOLS,
    "Dummy": _SYMBOLS,
    "dynamicsymbols": "functions_of_time('x y')",
    "Function": "functions_of_time('x'), or function('f')",
    "Rational": _NUMBER,
    "Integer": _NUMBER,
    "Float": "number('0.1')",
    "S": _NUMBER,
    "sympify": "number for numbers, parse for texts, from_sympy for SymPy's expressions",
    "nsimplify": _NUMBER,
    "D": "time_derivative(x), or diff(e, x)",
    "dt": "time_derivative(x)",
    "Derivative": "time_derivative(x), or diff(e, x)",
    "eye": "identity(n)",
    "ones": "Matrix([[1, 1]])",
    "ImmutableMatrix": "Matrix, which is immutable",
    "hessian": "jacobian(gradient(e, variables), variables)",
    "Eq": "the difference: an equation is an expression that is zero, left - right",
    "Heaviside": "(1 + sign(x))/2, or Piecewise((1, x))",
    "trigsimp": "simplify(e), or combine_trig(e)",
    "factor": "factor_terms(e)",
    "together": "factor_terms(e)",
    "cse": "listing, which names what is shared, or generate for code",
    "count_ops": "cost(e)",
    "pprint": "print(e), or latex(e); notebooks show formulas by themselves",
    "init_printing": "nothing: notebooks show formulas by themselves",
    "ccode": "generate(equations, 'c')",
    "fcode": "generate(equations, 'fortran')",
    "arcsin": "asin",
    "arccos": "acos",
    "arctan": "atan",
    "arctan2": "atan2",
    "ln": "log",
    "abs": "Abs",
    "max": "Max",
    "min": "Min",
    "E": "exp(1)",
    "ReferenceFrame": "Frame, made by rotate and translate from ground",
    "Particle": "Body(frame, m)",
    "RigidBody": "Body(frame, m, Ix, Iy, Iz)",
    "KanesMethod": f"newton_euler(system), of {_SYSTEM}",
    "LagrangesMethod": f"lagrange_equations(system), of {_SYSTEM}",
    "Lagrangian": f"lagrange_equations(system), of {_SYSTEM}",
    "make_BODY": "Body(G, m, Ix, Iy, Iz, Cyz, Cxz, Cxy)",
    "make_POINT": "Point(T, x, y, z)",
    "make_VECTOR": "Vector(T, x, y, z)",
    "make_FORCE": "Force(T, x, y, z, at=P, on=body)",
    "make_TORQUE": "Torque(T, x, y, z, on=body)",
    "join_points": "Q - P",
    "inv_frame": "T.inverse()",
    "CoM": "center_of_mass(body)",
    "dot_prod": "dot",
    "cross_prod": "cross",
}
"""Names that users look for in the package, and what to write instead."""

_EXPRESSION = {
    "evalf": "float(e) for a number, e.evaluate({x: 1.0}) else",
    "n": "float(e) for a number, e.evaluate({x: 1.0}) else",
    "xreplace": "e.subs({x: y})",
    "replace": "e.subs({x: y})",
    "simplify": "simplify(e)",
    "trigsimp": "simplify(e), or combine_trig(e)",
    "expand": "expand(e)",
    "factor": "factor_terms(e)",
    "collect": "collect(e, x)",
    "coeff": "coeff(e, x, 1)",
    "dt": "time_derivative(e)",
    "time_derivative": "time_derivative(e)",
    "doit": "nothing: derivatives are taken when they are written",
    "atoms": "e.free_symbols",
    "func": "e.kind",
    "count_ops": "cost(e)",
    "jacobian": "jacobian([e], [x, y])",
    "assumptions0": "e.assumption",
    "is_positive": "e.assumption, of a symbol",
    "is_real": "e.assumption, of a symbol",
    "is_Symbol": "e.kind == 'symbol'",
    "is_symbol": "e.kind == 'symbol'",
    "is_Number": "e.is_number",
    "T": "e itself: one expression is not a matrix",
}
"""Attributes that users look for in expressions, and what to write instead."""

_MATRIX = {
    "inv": "A.inverse()",
    "transpose": "A.T",
    "applyfunc": "A.map(function)",
    "jacobian": "jacobian(list(A), [x, y])",
    "col": "A[:, j]",
    "simplify": "A.map(simplify)",
    "expand": "A.map(expand)",
    "evalf": "lambdify(arguments, A)",
    "evaluate": "lambdify(arguments, A)",
    "dot": "A @ B",
    "dt": "A.time_derivative()",
    "LUsolve": "linear_solve(A, b), or solve(equations, unknowns)",
    "solve": "linear_solve(A, b), or solve(equations, unknowns)",
    "free_symbols": "symbody.symbolic.free_symbols(list(A))",
    "tomatrix": "A itself",
    "flatten": "A.entries",
    "eigenvals": "equilibrium(...), for the eigenvalues of small motions",
}
"""Attributes that users look for in matrices, and what to write instead."""

_HINTS: Mapping[str, Mapping[str, str]] = {"symbody": _MODULE, "Expr": _EXPRESSION, "Matrix": _MATRIX}


def no_attribute(owner: str, name: str) -> AttributeError:
    """Return the error for a name that does not exist, with what to write instead where that is known.

    >>> print(no_attribute("Matrix", "inv"))
    Matrix has no 'inv'; here it is A.inverse()
    """
    known = _HINTS[owner].get(name)
    return AttributeError(f"{owner} has no {name!r}" + (f"; here it is {known}" if known else ""))
