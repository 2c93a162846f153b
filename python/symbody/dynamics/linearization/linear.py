"""Linear models: the equations of small deviations from a steady motion, in symbols."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import accumulate, pairwise
from typing import Annotated, TypeAlias

from symbody.dynamics.equations.singular_mass import described_singularity
from symbody.errors import ModelError
from symbody.geometry.given.argument import checked
from symbody.multibody import Variables
from symbody.symbolic import Expr, Matrix, derivation, free_symbols
from symbody.symbolic.expression.latex_layout import displayed
from symbody.symbolic.given.arguments import brief

from .condition import Condition
from .dependent_columns import Pivots, solved
from .linear_page import LinearPage, names_table
from .second_order import FirstOrder, SecondOrder, second_order
from .variation import below, beside, picked

__all__ = ["Linear"]

Names: TypeAlias = Annotated[Sequence[Expr], "a list of states, such as [x, time_derivative(x)]"]


@dataclass(frozen=True, eq=False, repr=False)
class Linear:
    """Linear equations of small deviations: ``E x' = A0 x + B0 r`` and ``y = C0 x + C1 x' + D0 r``.

    The state x holds independent coordinates, independent speeds, and states beside the mechanics, each as a deviation
    from its value in the steady motion; r are inputs and y outputs, deviations as well. E is the identity but for the
    mass matrix. The names in `states`, `inputs` and `outputs` are those of rows and columns everywhere.

    Attributes:
        states: the names of x: independent coordinates, then speeds, then states.
        counts: the numbers of coordinates, speeds and states beside the mechanics in x.
        inputs: the names of r.
        outputs: the names of y.
        E: n x n.
        A0: n x n.
        B0: n x number of inputs.
        C0: number of outputs x n.
        C1: number of outputs x n; not zero for outputs that contain accelerations or multipliers.
        D0: number of outputs x number of inputs.
        second: the equations of second order, or a text why there are none.
        variables: all coordinates, then all speeds, dependent or not.
        recovery: the deviations of `variables` are ``recovery @ x``, as far as the inputs rest.
        about: the values of all variables in the steady motion; of coordinates that move, those at t = 0.
        ignorable: the coordinates on which nothing else depends, left out or not.
        conditions: what values of parameters must fulfil, so that `about` is a steady motion.
        system: the system that deviates.
        symbols_of_motion: symbols of the user's own in the steady motion, such as theta0 in ``{theta: theta0}``.
        definitions: speeds in the state that the system doesn't have, such as those along axes that turn, by its own.

    >>> from symbody import (
    ...     Body, Force, System, functions_of_time, ground, linearize, newton_euler, symbols, time_derivative, translate
    ... )
    >>> (x, F), (m, c, k) = functions_of_time("x F"), symbols("m c k")
    >>> cart = Body(translate(x, 0, 0), m)
    >>> load = Force(ground, F - k * x - c * time_derivative(x), 0, 0, at=cart.center_of_mass, on=cart)
    >>> linear = linearize(newton_euler(System([cart], [load], coordinates=[x])))
    >>> linear.A, linear.B
    (Matrix([[0, 1], [-k/m, -c/m]]), Matrix([[0], [1/m]]))
    """

    states: tuple[Expr, ...]
    counts: tuple[int, int, int]
    inputs: tuple[Expr, ...]
    outputs: tuple[str, ...]
    E: Matrix
    A0: Matrix
    B0: Matrix
    C0: Matrix
    C1: Matrix
    D0: Matrix
    second: SecondOrder | str
    variables: tuple[Expr, ...]
    recovery: Matrix
    about: Mapping[Expr, Expr]
    ignorable: tuple[Expr, ...]
    conditions: tuple[Condition, ...]
    system: Variables
    definitions: Mapping[Expr, Expr] = field(default_factory=dict)
    symbols_of_motion: tuple[Expr, ...] = ()

    @cached_property
    def parameters(self) -> tuple[Expr, ...]:
        """The symbols that need values, by name."""
        matrices = (self.E, self.A0, self.B0, self.C0, self.C1, self.D0)
        conditions = [each.value for each in self.conditions]
        leaves = free_symbols([*(entry for matrix in matrices for entry in matrix.entries), *conditions])
        return tuple(sorted(leaves, key=str))

    @property
    def name(self) -> str:
        """The name of the system."""
        return self.system.name

    @property
    def second_order(self) -> SecondOrder:
        """The equations ``M q'' + C q' + K q = F r``.

        Raises:
            ModelError: there are none.
        """
        if isinstance(self.second, SecondOrder):
            return self.second
        raise ModelError(
            f"Linear: the equations have no form M q'' + C q' + K q = F r: {self.second}; expected a use of E, A0 and "
            "B0, or of A and B, of first order"
        )

    @property
    def M(self) -> Matrix:
        """The mass matrix of ``M q'' + C q' + K q = F r``; C of these is ``second_order.C``."""
        return self.second_order.M

    @property
    def K(self) -> Matrix:
        """The coefficients of the deviations in ``M q'' + C q' + K q = F r``."""
        return self.second_order.K

    @property
    def A(self) -> Matrix:
        """A of ``x' = A x + B r``, n x n: ``E^-1 A0``."""
        return self._reduced[0]

    @property
    def B(self) -> Matrix:
        """B of ``x' = A x + B r``, n x number of inputs: ``E^-1 B0``."""
        return self._reduced[1]

    @cached_property
    def C(self) -> Matrix:
        """C of ``y = C x + D r``, number of outputs x n: ``C0 + C1 A``."""
        return self.C0 if _is_zero(self.C1) else self.C0 + self.C1 @ self.A

    @cached_property
    def D(self) -> Matrix:
        """D of ``y = C x + D r``, number of outputs x number of inputs: ``D0 + C1 B``."""
        return self.D0 if _is_zero(self.C1) else self.D0 + self.C1 @ self.B

    @cached_property
    def _reduced(self) -> tuple[Matrix, Matrix]:
        """``E^-1 A0`` and ``E^-1 B0``; larger mass matrices are solved for at run time."""
        n_s, n_v, n = len(self.coordinates), len(self.speeds), len(self.states)
        end = n_s + n_v
        mass, right = self.E[n_s:end, n_s:end], beside(self.A0, self.B0)
        if mass.rank() < n_v:
            raise ModelError(f"Linear: {described_singularity(mass, self.speeds)}, or use E, A0 and B0")
        with derivation():
            places = tuple(range(n_v))
            accelerations = solved(mass, Pivots(places, places), right[n_s:end, :])
            states = right[end:, :] - self.E[end:, n_s:end] @ accelerations
            whole = below(right[:n_s, :], accelerations, states)
        return whole[:, :n], whole[:, n:]

    @checked(ModelError)
    def part(self, states: Names) -> Linear:
        """Return the equations of some states on which the others have no influence, such as those of lateral motion.

        Outputs that depend on the other states are left out.

        Args:
            states: the states that stay, some of `states`.

        Raises:
            ModelError: a rate of one of them depends on another state, or a name is not known.

        >>> from symbody import equations_of, functions_of_time, linearize, symbols, time_derivative
        >>> (x, y), k = functions_of_time("x y"), symbols("k")
        >>> both = linearize(equations_of([[1, 0], [0, 1]], [-k * x, -3 * k * y], [x, y]))
        >>> both.part([y, time_derivative(y)]).A
        Matrix([[0, 1], [-3*k, 0]])
        """
        places = [self._place(name) for name in states]
        kept, others = sorted({*places}), [k for k in range(len(self.states)) if k not in places]
        for k in kept:
            for j in others:
                if not (self.A0[k, j].is_zero and self.E[k, j].is_zero):
                    raise ModelError(
                        f"Linear.part: the rate of {self.states[k]} depends on {self.states[j]}; expected states on "
                        "which the others have no influence: name that one, too, or leave the first one out"
                    )
        seen = [
            i
            for i in range(len(self.outputs))
            if all(self.C0[i, j].is_zero and self.C1[i, j].is_zero for j in others)
        ]
        s, v, z = (sum(low <= k < high for k in kept) for low, high in pairwise(self._ends))
        made = replace(
            self,
            states=tuple(self.states[k] for k in kept),
            counts=(s, v, z),
            outputs=tuple(self.outputs[i] for i in seen),
            E=picked(self.E, kept, kept),
            A0=picked(self.A0, kept, kept),
            B0=picked(self.B0, kept, None),
            C0=picked(self.C0, seen, kept),
            C1=picked(self.C1, seen, kept),
            D0=picked(self.D0, seen, None),
            recovery=picked(self.recovery, None, kept),
            ignorable=tuple(q for q in self.ignorable if q in states),
        )
        return replace(made, second=second_order(made.first_order))

    def _place(self, name: Expr) -> int:
        if name not in self.states:
            raise ModelError(
                f"Linear.part: {brief(name)} is not a state; expected some of {brief(', '.join(map(str, self.states)))}"
            )
        return self.states.index(name)

    @property
    def _ends(self) -> tuple[int, ...]:
        """The places at which coordinates, speeds and states beside the mechanics begin, and that of the end."""
        return tuple(accumulate(self.counts, initial=0))

    @property
    def first_order(self) -> FirstOrder:
        """The equations in the parts of which those of second order are made."""
        _, s, v, n = self._ends
        N, X = self.A0[:s, :], self.A0[s:v, :]
        return FirstOrder(
            self.coordinates,
            self.speeds,
            (N[:, :s], N[:, s:v], self.B0[:s, :]),
            self.E[s:v, s:v],
            (X[:, :s], X[:, s:v], X[:, v:n], self.B0[s:v, :]),
        )

    @property
    def coordinates(self) -> tuple[Expr, ...]:
        """The independent coordinates in the state."""
        return self.states[: self.counts[0]]

    @property
    def speeds(self) -> tuple[Expr, ...]:
        """The independent speeds in the state."""
        return self.states[self.counts[0] : sum(self.counts[:2])]

    def latex(self) -> str:
        """Return ``M q'' + C q' + K q = F r`` in LaTeX, or ``E x' = A0 x + B0 r`` if there is no such form.

        The names stand for deviations from the steady motion.
        """
        return self._page.latex()

    def description(self) -> str:
        """Return the same as text, and each matrix row by row."""
        return self._page.description()

    @property
    def _page(self) -> LinearPage:
        return LinearPage(self.second, (self.E, self.A0, self.B0), self.states, self.inputs)

    def _repr_latex_(self) -> str | None:
        return displayed(self._page.latex()) if self._page.is_short else None

    def _repr_html_(self) -> str | None:
        """Return the names of a model that is too long to be read."""
        if self._page.is_short:
            return None
        names = {
            "coordinates": self.coordinates,
            "speeds": self.speeds,
            "states beside the mechanics": self.states[sum(self.counts[:2]) :],
            "inputs": self.inputs,
            "outputs": self.outputs,
            "ignorable coordinates": self.ignorable,
        }
        return names_table(names, self._page.operations)

    def __repr__(self) -> str:
        states, inputs, outputs = (
            ", ".join(map(str, names)) for names in (self.states, self.inputs, self.outputs)
        )
        return f"Linear(states {states}; inputs {inputs or 'none'}; outputs {outputs or 'none'})"


def _is_zero(matrix: Matrix) -> bool:
    return all(entry.is_zero for entry in matrix.entries)
