"""Equations in matrix form: ``M(q) q'' + C(q, q') q' + g(q) + loads = Q + phi_q^T lambda``.

Where the terms come from is known of systems of bodies alone. Equations that were given by M and f have the form
``M q'' = f + phi_q^T lambda``; with Christoffel's symbols, which follow from M, f is without the terms of ``C q'``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from textwrap import wrap

from symbody.deferred import cached_property
from symbody.errors import notify
from symbody.multibody import System, Variables
from symbody.symbolic import Expr, Matrix, diff, free_symbols, latex, number, zeros
from symbody.symbolic.expression.latex_layout import aligned, bmatrix, displayed
from symbody.symbolic.expression.text_layout import LINE, lines
from symbody.symbolic.given.arguments import brief

from .abridged import PAGES
from .balance import Balance
from .causes import generalized_forces
from .inertia_sign import with_positive_inertia
from .like_terms import joined
from .names_of_formulas import with_one_naming
from .page import Page
from .reader_of import reader_of
from .row import printed
from .short_names import Definition, in_order_of_use, shortened

_FEW = 3
"""An entry of at most so many lines is written out in an abridged description."""
_ADVICE = """\
Too long to be read at once. One entry: form.mass_matrix[0, 0], or form.coriolis[0, 0];
all of the {count} lines: print(form.description(whole=True))."""
_BY_SPEEDS = 1.25
"""How many times longer than another form an entry of C with one term for each speed may be."""
_TWO_DIGITS = 10
"""Speeds from which on indices have two digits."""
_NAMED = 3
"""The quasi-velocities that a notice names."""


@dataclass(frozen=True)
class MatrixForm:
    """The matrices of equations of motion, each entry in its form for the reader.

    Attributes:
        system: the system to which the equations belong.
        mass_matrix: M(q), n x n.
        coriolis: C(q, q') n x n by Christoffel's symbols, or the vector c(q, q'), n x 1.
        gravity: g(q), n x 1.
        loads: the forces of springs, dampers and others, n x 1.
        applied: the given forces Q, n x 1; of equations that were given by M and f, all forces f, as nothing tells
            weight, springs and products of speeds apart there.
        constraints: ``phi_q^T lambda``, n x 1.
        is_christoffel: whether `coriolis` is C, not c.
        named: names of forces, such as those along lines with their lengths, if the loads are printed with them.
        named_loads: the loads with these names.

    >>> from symbody import Body, Point, System, Vector, functions_of_time, ground, newton_euler, rotate, symbols
    >>> theta, (m, l, g) = functions_of_time("theta"), symbols("m l g")
    >>> bob = Body(Point(rotate("Z", theta), 0, -l, 0), m)
    >>> form = newton_euler(System([bob], coordinates=[theta], gravity=Vector(ground, 0, -g, 0))).matrix_form()
    >>> print(form.description())
    M*theta'' + g(q) = 0
        M11 = m*l**2
        g1 = g*l*m*sin(theta)
    """

    system: Variables
    mass_matrix: Matrix
    coriolis: Matrix
    gravity: Matrix
    loads: Matrix
    applied: Matrix
    constraints: Matrix
    is_christoffel: bool = False
    named: tuple[tuple[Expr, Expr], ...] = ()
    named_loads: Matrix | None = None

    def description(self, *, whole: bool = False) -> str:
        """Return the equation of matrices, and their entries other than zero line by line.

        Equal entries of M and of C stand on one line, and an opposite of an entry above is written as such. A matrix of
        whose name the model has a parameter is written with its arguments, ``M(q)``. Loads that have names are listed.
        If all this fills more than two pages, only short entries are written out, and the lines of the others counted.

        Args:
            whole: whether all entries are written out, however many pages they fill.
        """
        text = self._description
        return text if whole or text.count("\n") <= PAGES else self._abridged(text.count("\n"))

    @cached_property
    def _description(self) -> str:
        definitions, rows = shortened(*self._rows())
        made = [*self._named_causes(), *(f"{name} := {value}" for name, value in definitions), *rows]
        return "\n".join([self._equation(), *(line for text in made for line in _indented(text))])

    def _abridged(self, count: int) -> str:
        """Return the entries of few lines, the number of lines of each other entry, and how to see these."""
        value_of, shown, long = dict(self._labelled()), [*self._named_causes()], list[str]()
        shown += [f"{name} := {value}" for name, value in self._printed([], "text")[0]]
        for equal, right in self._entries():
            row = f"{' = '.join(equal)} = "
            known, texts = (
                printed([value_of[right]], "text", self.system) if right in value_of else ([], [right])
            )
            size = sum(len(_indented(each)) for each in (*(value for _, value in known), row + texts[0]))
            if known or size > _FEW:
                long.append(f"{equal[0]} ({size})")
            else:
                shown.append(row + texts[0])
        lines = [line for text in shown for line in _indented(text)]
        others = wrap(f"longer entries and their numbers of lines: {', '.join(long)}", LINE - 8)
        advice = _ADVICE.format(count=count).splitlines()
        return "\n".join([self._equation(), *lines, *(f"    {line}" for line in (*others, *advice))])

    def __repr__(self) -> str:
        return f"MatrixForm({self._equation()}, coordinates {brief(', '.join(map(str, self.system.coordinates)))})"

    def _rows(self) -> tuple[list[str], tuple[()], list[Definition]]:
        """Return the rows of text without short names, and the quantities that have names."""
        labels, values = zip(*self._labelled(), strict=True)
        definitions, texts = self._printed(values, "text")
        text_of = dict(zip(labels, texts, strict=True))
        rows = [f"{' = '.join(equal)} = {text_of.get(right, right)}" for equal, right in self._entries()]
        return rows, (), definitions

    def _printed(self, values: Sequence[Expr], notation: str) -> tuple[list[Definition], list[str]]:
        """Return the quantities that have names, and printed values."""
        sides = [side for pair in self.named for side in pair]
        definitions, texts = printed([*values, *sides], notation, self.system)
        named = texts[len(values) :]
        pairs = zip(named[::2], named[1::2], strict=True)
        made = [self._positive(value, text) for value, text in zip(values, texts, strict=False)]
        return in_order_of_use([*definitions, *pairs]), made

    def _positive(self, value: Expr, text: str) -> str:
        """Return the text of an entry of M with the sign of inertia; that of any other as it is."""
        size = self.mass_matrix.rows
        if any(value == self.mass_matrix[k, k] for k in range(size)):
            return with_positive_inertia(text)
        return with_positive_inertia(text, least=3) if value in self.mass_matrix.entries else text

    @with_one_naming
    def latex(self) -> str:
        """Return the equation and the matrices in LaTeX, one below the other, with the short names of the text.

        Matrices are bold, as no parameter is.
        """
        named = [(name, matrix) for name, matrix in self._matrices() if _is_used(matrix)]
        values = [entry for _, matrix in named for entry in matrix.entries]
        definitions, texts = self._printed(values, "latex")
        given = self._rows()
        has_names = shortened(*given)[0] != given[2]
        definitions, texts = shortened(texts, (), definitions, "latex", is_wanted=has_names)
        remaining = iter(texts)
        rows = [rf"&{self._equation(_bold)}", *(f"{name} &= {value}" for name, value in definitions)]
        for name, matrix in named:
            entries = [next(remaining) for _ in matrix.entries]
            rows.append(f"{_bold(name)} &= {bmatrix(entries, matrix.shape[1])}")
        return aligned(rows)

    def _repr_latex_(self) -> str | None:
        return displayed(self.latex()) if self._description.count("\n") <= PAGES else None

    def _matrices(self) -> list[tuple[str, Matrix]]:
        name = "C" if self.is_christoffel else "c"
        loads = self.loads if self.named_loads is None else self.named_loads
        matrices = (self.mass_matrix, self.coriolis, self.gravity, loads, self.applied, self.constraints)
        applied = "Q" if isinstance(self.system, System) else "f"
        return list(zip(("M", name, "g", "k", applied, "R"), matrices, strict=True))

    def _labelled(self) -> list[tuple[str, Expr]]:
        """Return the entries and their labels: ``M12``, or ``M[1,2]`` if a name of the model looks like one."""
        entries = [entry for _, matrix in self._matrices() for entry in matrix.entries]
        defined = [side for pair in self.named for side in pair]
        taken = {leaf.name for leaf in free_symbols([*entries, *defined])}
        plain, indexed = self._with_labels("{}{}"), self._with_labels("{}[{}]")
        is_plain = self.mass_matrix.rows < _TWO_DIGITS and not taken & {label for label, _ in plain}
        return plain if is_plain else indexed

    def _with_labels(self, style: str) -> list[tuple[str, Expr]]:
        made = []
        comma = "," if "[" in style else ""
        for name, matrix in self._matrices():
            rows, columns = matrix.shape
            is_square = columns > 1 or name in {"M", "C"}
            for i in range(rows):
                for j in range(columns):
                    index = f"{i + 1}{comma}{j + 1}" if is_square else f"{i + 1}"
                    made.append((style.format(name, index), matrix[i, j]))
        return made

    def _entries(self) -> list[tuple[list[str], str]]:
        """Return the labels of the entries other than zero, and what stands on the right: a label or its opposite."""
        rows = list[tuple[list[str], str]]()
        known = dict[tuple[str, Expr], list[str]]()
        for label, value in self._labelled():
            kind = label[0] if label[0] in "MC" else label
            if value.is_zero:
                continue
            if (kind, value) in known:
                known[kind, value].append(label)
                continue
            opposite = known.get((kind, -value))
            rows.append(([label], label if opposite is None else f"-{opposite[0]}"))
            known[kind, value] = rows[-1][0]
        return rows

    def _equation(self, style: Callable[[str], str] | None = None) -> str:
        """Return the equation of matrices: as text, or with their names and factors in a style of LaTeX."""
        name, times = (self._with_arguments, "*") if style is None else (style, " ")
        left = [f"{name('M')}{times}{self._rate(style, is_acceleration=True)}"]
        if _is_used(self.coriolis):
            speed = self._rate(style, is_acceleration=False)
            left.append(f"{name('C')}{times}{speed}" if self.is_christoffel else name("c"))
        left += [name(each) for each, matrix in self._matrices()[2:4] if _is_used(matrix)]
        right = [name(each) for each, matrix in self._matrices()[4:] if _is_used(matrix)]
        return f"{' + '.join(left)} = {' + '.join(right) or '0'}"

    def _rate(self, style: Callable[[str], str] | None, *, is_acceleration: bool) -> str:
        """Return the vector of speeds or accelerations, or the only one."""
        if len(self.system.speeds) == 1:
            (only,) = self.system.accelerations if is_acceleration else self.system.speeds
            return str(only) if style is None else latex(only)
        letter = "u" if self.system.has_quasi_velocities and is_acceleration else "q"
        dots = 1 if letter == "u" or not is_acceleration else 2
        return letter + dots * "'" if style is None else rf"\{'d' * dots}ot{{{style(letter)}}}"

    def _with_arguments(self, name: str) -> str:
        """Return the name of a matrix, with its arguments if the model has something of this name."""
        taken = {leaf.name for leaf in self.system.leaves}
        speed = "u" if self.system.has_quasi_velocities else "q'"
        return f"{name}{_ARGUMENTS[name].format(speed)}" if name in taken else name

    def _named_causes(self) -> list[str]:
        """Return lines that tell which loads are in k, and which in Q, if there are names."""
        system = self.system
        if not isinstance(system, System) or not any(load.name for load in system.loads):
            return []
        causes = [
            (load.name or type(load).__name__.lower(), generalized_forces(system, load.actions))
            for load in system.loads
        ]
        moving = [name for name, forces in causes if any(not each.is_zero for each in forces.moving)]
        given = [name for name, forces in causes if any(not each.is_zero for each in forces.given)]
        return [
            f"{self._with_arguments(matrix)}: {', '.join(dict.fromkeys(names))}"
            for matrix, names, value in (("k", moving, self.loads), ("Q", given, self.applied))
            if names and _is_used(value)
        ]


_ARGUMENTS = {
    "M": "(q)",
    "C": "(q, {})",
    "c": "(q, {})",
    "g": "(q)",
    "k": "(q, {})",
    "Q": "(q, t)",
    "f": "(q, {}, t)",
    "R": "(q, lambda)",
}
"""The arguments of the matrices, with a place for the speeds."""


def _bold(name: str) -> str:
    return rf"\mathbf{{{name}}}"


def matrix_form(
    system: Variables, mass_matrix: Matrix, balances: Sequence[Balance], *, christoffel: bool
) -> MatrixForm:
    """Return the matrices of equations whose terms are known by their kinds; M is in its form for the reader.

    A notice (`ModelNotice`) tells why c(q, q') stands in the place of C(q, q').
    """
    if not isinstance(system, System):
        return _of_given(system, mass_matrix, balances, christoffel=christoffel)
    coriolis, is_christoffel = _column([balance.velocities for balance in balances]), False
    if christoffel and system.has_quasi_velocities:
        _notice(_no_rates(system))
    elif christoffel:
        found = by_christoffel(mass_matrix, system)
        if found @ Matrix([[u] for u in system.speeds]) == coriolis:
            coriolis, is_christoffel = found, True
        else:
            _notice(
                "Christoffel's symbols of the mass matrix don't give it; where a support moves or loads depend on "
                "products of speeds, they do not"
            )
    return MatrixForm(
        system,
        mass_matrix,
        coriolis,
        _column([balance.gravity for balance in balances]),
        _column([balance.loads for balance in balances]),
        _column([balance.applied for balance in balances]),
        _column([balance.constraints for balance in balances]),
        is_christoffel,
    )


def with_names(form: MatrixForm, page: Page) -> MatrixForm:
    """Return the matrices with the loads of a page of the same equations, and its names of forces.

    On a page, forces with names may be on the right; here they stay loads, as they depend on the motion.
    """
    loads, applied = (
        _column(terms) for terms in zip(*((each.loads, each.applied) for each in page.balances), strict=True)
    )
    if not page.named:
        return replace(form, loads=loads)
    return replace(form, named=page.named, named_loads=loads - (applied - form.applied))


def _of_given(
    system: Variables, mass_matrix: Matrix, balances: Sequence[Balance], *, christoffel: bool
) -> MatrixForm:
    """Return the matrices of equations that were given without bodies; C, if it is wanted, follows from M alone."""
    n = len(balances)
    nothing = zeros(n, 1)
    terms = [(*balance.velocities, *balance.gravity, *balance.loads) for balance in balances]
    forces = _column([balance.applied for balance in balances]) - _column(terms)
    coriolis, is_christoffel = nothing, False
    if christoffel and (system.has_quasi_velocities or mass_matrix != mass_matrix.T):
        reason = _no_rates(system) if system.has_quasi_velocities else "the mass matrix isn't symmetric"
        _notice(reason, "f(q, q')")
    elif christoffel:
        coriolis, is_christoffel = by_christoffel(mass_matrix, system), True
        products = coriolis @ Matrix([[u] for u in system.speeds])
        forces = Matrix([[reader_of(system).form(each)] for each in (forces + products).entries])
    constraints = _column([balance.constraints for balance in balances])
    return MatrixForm(
        system, mass_matrix, coriolis, nothing, nothing, forces, constraints, is_christoffel=is_christoffel
    )


def _no_rates(system: Variables) -> str:
    first = ", ".join(map(str, system.quasi_velocities[:_NAMED]))
    return f"the speeds {first} are not rates of coordinates, on which Christoffel's symbols depend"


def _notice(reason: str, instead: str = "c(q, q')") -> None:
    notify(f"matrix_form: {instead} is returned instead of the matrix C(q, q'), since {reason}")


def by_christoffel(mass_matrix: Matrix, system: Variables) -> Matrix:
    """Return the matrix C(q, q') of Christoffel's symbols: ``c_ijk = (dM_ij/dq_k + dM_ik/dq_j - dM_jk/dq_i)/2``.

    With it, M' - 2 C is skew-symmetric [Murray, Li & Sastry 1994, sec. 4.2].
    """
    q, n, reader = system.coordinates, len(system.coordinates), reader_of(system)
    rates = [[[diff(mass_matrix[i, j], q[k]) for k in range(n)] for j in range(n)] for i in range(n)]

    def entry(i: int, j: int) -> Expr:
        slopes = ((rates[i][j][k] + rates[i][k][j] - rates[j][k][i]) / 2 for k in range(n))
        products = [(slope, u) for slope, u in zip(slopes, system.speeds, strict=True) if not slope.is_zero]
        total = sum((slope * u for slope, u in products), start=number(0))
        by_speeds = sum(joined(products, reader), start=number(0))
        form = reader.form(total)
        return by_speeds if reader.length(by_speeds) <= _BY_SPEEDS * reader.length(form) else form

    return Matrix([[entry(i, j) for j in range(n)] for i in range(n)])


def _column(rows: Sequence[Sequence[Expr]]) -> Matrix:
    return Matrix([[sum(terms, start=number(0))] for terms in rows])


def _is_used(matrix: Matrix) -> bool:
    return not all(entry.is_zero for entry in matrix.entries)


def _indented(text: str) -> list[str]:
    first, *others = lines(text, LINE - 8)
    return ["    " + first, *(8 * " " + other for other in others)]
