"""Random trees, and rewrites of trees that keep their value on the real line.

A rewrite returns None where it doesn't apply. Those of `ANYWHERE` hold for complex values too; those of `REAL_ONLY`
are for trees without complex leaves. Whether a rewritten tree has the same value is judged by numbers all the same.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from fractions import Fraction

from tests.laws.trees import (
    ELEMENTARY,
    MINUS_ONE,
    ONE,
    PI,
    REWRITES,
    TWO,
    ZERO,
    Tree,
    holds_complex_leaf,
    leaf,
    negative,
    number,
    power,
    root,
)

NUMBERS = tuple(
    map(
        Fraction,
        (
            1,
            2,
            3,
            4,
            5,
            6,
            7,
            12,
            -1,
            -2,
            -3,
            67,
            109,
            -134,
            10**25 + 3,
            "1/2",
            "1/3",
            "-3/4",
            "981/100",
            "67/109",
        ),
    )
)
ANGLES = tuple(map(Fraction, ("1/2", "1/3", "1/5", "3/8", "2/7", "-5/12")))
EXPONENTS = tuple(map(Fraction, ("2", "2", "3", "-1", "-2", "1/2", "1/2", "-1/2", "1/3", "2/3", "-3/2")))
FUNCTIONS = (*ELEMENTARY, "abs", "abs", "abs", "sign", "sign")
"""Roots and moduli come most often."""

Rewrite = Callable[[Tree, random.Random], Tree | None]


# --- random trees ----------------------------------------------------------------------------------------------------


def random_tree(
    draw: random.Random, depth: int, leaves: Sequence[str] = ("x", "y", "x0", "x1", "a", "b")
) -> Tree:
    """Return a tree of functions nested to this depth."""

    def again() -> Tree:
        return random_tree(draw, draw.randint(0, depth - 1), leaves)

    def linear() -> Tree:
        return ("+", ("*", _constant(draw), again()), again())

    if depth == 0:
        return _random_leaf(draw, leaves)
    match draw.randrange(12):
        case 0 | 1:
            return ("+", *(again() for _ in range(draw.randint(2, 3))))
        case 2:
            return ("*", *(again() for _ in range(draw.randint(2, 3))))
        case 3:
            return ("/", again(), draw.choice((again, linear))())
        case 4 | 5:
            return ("^", draw.choice((again, linear))(), number(draw.choice(EXPONENTS)))
        case 6:
            return _sum_of_squares(draw, leaves)
        case 7 | 8 | 9:
            return (draw.choice(FUNCTIONS), draw.choice((again, again, linear))())
        case 10:
            return (draw.choice(("Min", "Max", "Min", "Max", "atan2", "f")), again(), again())
    if draw.random() < 0.5:
        return ("^", draw.choice((number(2), number(Fraction(3, 2)), leaf("a"))), again())
    return ("Piecewise", again(), again(), again())


def _constant(draw: random.Random) -> Tree:
    return PI if draw.random() < 0.1 else number(draw.choice(NUMBERS))


def _random_leaf(draw: random.Random, leaves: Sequence[str]) -> Tree:
    if draw.random() < 0.75:
        return leaf(draw.choice(leaves))
    if draw.random() < 0.2:
        return ("*", number(draw.choice(ANGLES)), PI)
    return _constant(draw)


def _sum_of_squares(draw: random.Random, leaves: Sequence[str]) -> Tree:
    """Return the length of a vector, which models are full of."""
    squares = [power(_random_leaf(draw, leaves), 2) for _ in range(2)]
    return root(("+", *squares, draw.choice((ONE, power(leaf("a"), 2)))))


# --- tools -----------------------------------------------------------------------------------------------------------


def _distributed(factor: Tree, tree: Tree) -> Tree:
    """Return the factor times the tree, multiplied into its terms."""
    if tree[0] == "+":
        return ("+", *(("*", factor, term) for term in tree[1:]))
    return ("*", factor, tree)


def _positive(draw: random.Random) -> Tree:
    numbers = [number(each) for each in NUMBERS if each > 0]
    return draw.choice([leaf("a"), leaf("b"), ("+", leaf("a"), ONE), power(leaf("b"), 2), *numbers])


def _sum(draw: random.Random) -> Tree:
    choices = (("+", leaf("a"), ONE), ("+", leaf("x"), leaf("y")), ("+", leaf("x"), number(3)), leaf("x"))
    return draw.choice(choices)


def _squared_sine(draw: random.Random) -> tuple[Tree, Tree]:
    angle = draw.choice((leaf("x"), leaf("x0"), ("+", leaf("x"), leaf("a"))))
    return power(("sin", angle), 2), power(("cos", angle), 2)


def _halved(tree: Tree, parts: int = 2) -> Tree:
    return ("/", tree, number(parts))


def _is_number(tree: Tree) -> bool:
    return bool(tree[0] == "number")


def _is_positive(tree: Tree) -> bool:
    return (_is_number(tree) and tree[1] > 0) or tree in (leaf("a"), leaf("b"), PI)


def _is_root(tree: Tree) -> bool:
    return tree[0] == "^" and _is_number(tree[2]) and tree[2][1].denominator > 1


# --- of any tree -----------------------------------------------------------------------------------------------------


def _quotient_with_sum(u: Tree, draw: random.Random) -> Tree:
    """U = u c/c, with c multiplied into u."""
    c = _sum(draw)
    return ("/", _distributed(c, u), c)


def _quotient_with_terms(u: Tree, draw: random.Random) -> Tree:
    """U = (u c + u d)/(c + d)."""
    c, d = _sum(draw), _positive(draw)
    return ("/", ("+", _distributed(c, u), _distributed(d, u)), ("+", c, d))


def _product_with_one(u: Tree, draw: random.Random) -> Tree:
    sine, cosine = _squared_sine(draw)
    return ("+", ("*", u, sine), ("*", u, cosine))


def _zero_added(u: Tree, draw: random.Random) -> Tree:
    c = _sum(draw)
    return ("+", ("*", ("+", c, ONE), ("+", u, c)), negative(("*", c, ("+", u, c, ONE))))


def _hidden_number(u: Tree, draw: random.Random) -> Tree:
    three, two = root(number(3)), root(TWO)
    one = draw.choice(
        (
            ("/", ("*", ("+", three, ONE), ("+", three, MINUS_ONE)), TWO),
            ("/", ("*", power(TWO, Fraction(1, 3)), power(number(4), Fraction(1, 3))), TWO),
            ("/", ("*", two, three), root(number(6))),
            ("*", TWO, ("cos", ("/", PI, number(3)))),
            ("/", root(number(67)), root(number(67))),
            ("/", ("*", root(number(109)), root(number(67))), root(number(67 * 109))),
        )
    )
    return ("*", one, u)


def _through_a_length(u: Tree, draw: random.Random) -> Tree:
    """U = (u x²/r + u y²/r + u/r)/r, where r² = x² + y² + 1; or u = u/r r."""
    squares = (power(leaf("x"), 2), power(leaf("y"), 2), ONE)
    r = root(("+", *squares))
    if draw.random() < 0.5:
        return ("/", ("+", *(("/", ("*", u, square), r) for square in squares)), r)
    return ("/", ("*", u, r, r), ("+", *squares))


def _difference_of_squares(u: Tree, draw: random.Random) -> Tree:
    """U = (u² - c²)/(u + c) + c."""
    c = _sum(draw)
    return ("+", ("/", ("+", power(u, 2), negative(power(c, 2))), ("+", u, c)), c)


def _sum_with_difference(u: Tree, draw: random.Random) -> Tree:
    c = _sum(draw)
    return ("+", _quotient_with_sum(u, draw), negative(_distributed(c, c)), power(c, 2))


# --- of some trees ---------------------------------------------------------------------------------------------------


def _multiplied_out(u: Tree, draw: random.Random) -> Tree | None:
    """C (u + v) = c u + c v, and (u + v)/c = u/c + v/c."""
    match u:
        case ("*", c, ("+", *terms)) | ("*", ("+", *terms), c):
            return ("+", *(("*", c, term) for term in terms))
        case ("/", ("+", *terms), c):
            return ("+", *(("/", term, c) for term in terms))
        case ("^", ("+", *terms), ("number", Fraction(numerator=2, denominator=1))):
            return ("+", *(("*", one, two) for one in terms for two in terms))
    return None


def _product_by_squares(u: Tree, draw: random.Random) -> Tree | None:
    match u:
        case ("*", one, two):
            squares = (power(("+", one, two), 2), negative(power(("+", one, negative(two)), 2)))
            return ("/", ("+", *squares), number(4))
    return None


def _exponent_split(u: Tree, draw: random.Random) -> Tree | None:
    match u:
        case ("^", base, ("number", exponent)) if exponent != 1:
            return draw.choice(
                (
                    ("*", power(base, exponent - 1), base),
                    ("/", power(base, exponent + 1), base),
                    power(power(base, exponent / 2), 2),
                    power(power(base, exponent / 3), 3),
                )
            )
    return None


def _trigonometry(u: Tree, draw: random.Random) -> Tree | None:
    match u:
        case ("tan", v):
            return ("/", ("sin", v), ("cos", v))
        case ("sin", ("+", v, w)):
            return ("+", ("*", ("sin", v), ("cos", w)), ("*", ("cos", v), ("sin", w)))
        case ("sin", v):
            return ("*", TWO, ("sin", _halved(v)), ("cos", _halved(v)))
        case ("cos", v):
            return ("+", ONE, ("*", number(-2), power(("sin", _halved(v)), 2)))
        case ("asin", v):
            return ("+", ("/", PI, TWO), negative(("acos", v)))
        case ("acos", v):
            return ("+", ("/", PI, TWO), negative(("asin", v)))
        case ("atan", v):
            return negative(("atan", negative(v)))
    return None


def _exponentials(u: Tree, draw: random.Random) -> Tree | None:
    match u:
        case ("exp", ("+", *terms)):
            return ("*", *(("exp", term) for term in terms))
        case ("exp", v):
            return power(("exp", _halved(v, 3)), 3)
        case ("cosh", v):
            return _halved(("+", ("exp", v), ("exp", negative(v))))
        case ("sinh", v):
            return _halved(("+", ("exp", v), negative(("exp", negative(v)))))
        case ("tanh", v):
            return ("/", ("sinh", v), ("cosh", v))
        case ("^", base, exponent) if _is_positive(base) and not _is_number(exponent):
            return ("exp", ("*", exponent, ("log", base)))
    return None


def _roots_of_scaled(u: Tree, draw: random.Random) -> Tree | None:
    """U**k = (c u)**k/c**k for a positive c."""
    if not _is_root(u):
        return None
    _, base, exponent = u
    c = _positive(draw)
    if draw.random() < 0.5:
        return ("/", ("^", _distributed(power(c, 2), base), exponent), ("^", c, ("*", TWO, exponent)))
    return ("/", ("^", _distributed(c, base), exponent), ("^", c, exponent))


def _logarithm(u: Tree, draw: random.Random) -> Tree | None:
    match u:
        case ("log", v):
            c = _positive(draw)
            return ("+", ("log", _distributed(c, v)), negative(("log", c)))
    return None


def _positive_leaf(u: Tree, draw: random.Random) -> Tree | None:
    if not _is_positive(u):
        return None
    return draw.choice(
        (
            ("exp", ("log", u)),
            power(root(u), 2),
            root(power(u, 2)),
            ("abs", u),
            power(power(u, Fraction(1, 3)), 3),
            ("*", root(u), root(u)),
            ("exp", _halved(("*", ("log", power(u, 2)), ONE))),
        )
    )


# --- of real values --------------------------------------------------------------------------------------------------


def _moduli(u: Tree, draw: random.Random) -> Tree | None:
    c = _positive(draw)
    match u:
        case ("abs", ("*" | "/" as operation, v, w)):
            return (operation, ("abs", v), ("abs", w))
        case ("abs", v):
            return draw.choice(
                (
                    root(power(v, 2)),
                    ("*", v, ("sign", v)),
                    ("Max", v, negative(v)),
                    ("abs", _distributed(MINUS_ONE, v)),
                    ("/", ("abs", _distributed(c, v)), c),
                    ("/", power(v, 2), ("abs", v)),
                )
            )
        case ("sign", ("*" | "/" as operation, v, w)):
            return (operation, ("sign", v), ("sign", w))
        case ("sign", v):
            return draw.choice(
                (
                    ("/", v, ("abs", v)),
                    ("/", ("abs", v), v),
                    ("sign", _distributed(c, v)),
                    power(("sign", v), 3),
                    negative(("sign", negative(v))),
                )
            )
        case ("^", ("^", v, ("number", Fraction(numerator=2, denominator=1))), ("number", exponent)):
            return power(("abs", v), 2 * exponent)
    return None


def _extrema(u: Tree, draw: random.Random) -> Tree | None:
    match u:
        case ("Max" | "Min" as name, v, w):
            sign, other = (ONE, "Min") if name == "Max" else (MINUS_ONE, "Max")
            distance = ("*", sign, ("abs", ("+", v, negative(w))))
            difference, c = ("+", v, negative(w)), _positive(draw)
            return draw.choice(
                (
                    _halved(("+", v, w, distance)),
                    negative((other, negative(v), negative(w))),
                    (name, w, v),
                    ("/", (name, _distributed(c, v), _distributed(c, w)), c),
                    ("+", v, w, negative((other, v, w))),
                    ("Piecewise", v, difference, w) if name == "Max" else ("Piecewise", w, difference, v),
                )
            )
    return None


def _branches(u: Tree, draw: random.Random) -> Tree | None:
    match u:
        case ("Piecewise", v, condition, otherwise):
            sign = ("sign", condition)
            indicators = (_halved(("+", ONE, sign)), _halved(("+", ONE, negative(sign))))
            return draw.choice(
                (
                    ("+", ("*", v, indicators[0]), ("*", otherwise, indicators[1])),
                    ("Piecewise", v, _distributed(_positive(draw), condition), otherwise),
                    ("Piecewise", otherwise, _distributed(MINUS_ONE, condition), v),
                    ("+", ("Piecewise", ("+", v, negative(otherwise)), condition, ZERO), otherwise),
                )
            )
    return None


def _directions(u: Tree, draw: random.Random) -> Tree | None:
    match u:
        case ("atan2", y, x):
            c = _positive(draw)
            return draw.choice(
                (
                    ("atan2", _distributed(c, y), _distributed(c, x)),
                    negative(("atan2", negative(y), x)),
                    ("*", TWO, ("atan", ("/", y, ("+", x, root(("+", power(x, 2), power(y, 2))))))),
                )
            )
    return None


ANY_TREE: tuple[Rewrite, ...] = (
    _quotient_with_sum,
    _quotient_with_terms,
    _product_with_one,
    _zero_added,
    _hidden_number,
    _through_a_length,
    _difference_of_squares,
    _sum_with_difference,
)
SOME_TREES: tuple[Rewrite, ...] = (
    _multiplied_out,
    _product_by_squares,
    _exponent_split,
    _trigonometry,
    _exponentials,
    _roots_of_scaled,
    _logarithm,
    _positive_leaf,
)
REAL_ONLY: tuple[Rewrite, ...] = (_moduli, _extrema, _branches, _directions)


# --- anywhere in a tree ----------------------------------------------------------------------------------------------


def _places(tree: Tree, path: tuple[int, ...] = ()) -> list[tuple[int, ...]]:
    """Return the paths of all subtrees that may be rewritten: numbers that are exponents stay."""
    found = [path]
    for k, part in enumerate(tree[1:], 1):
        if isinstance(part, tuple) and not (tree[0] == "^" and k == 2 and _is_number(part)):
            found += _places(part, (*path, k))
    return found


def _at(tree: Tree, path: tuple[int, ...]) -> Tree:
    for k in path:
        tree = tree[k]
    return tree


def _replaced(tree: Tree, path: tuple[int, ...], new: Tree) -> Tree:
    if not path:
        return new
    k, *rest = path
    return (*tree[:k], _replaced(tree[k], tuple(rest), new), *tree[k + 1 :])


def rewritten(tree: Tree, draw: random.Random) -> tuple[Tree, str]:
    """Return the tree with one of its subtrees rewritten, and the name of the rewrite."""
    places = _places(tree)
    specific = SOME_TREES if holds_complex_leaf(tree) else (*SOME_TREES, *REAL_ONLY)
    if draw.random() < 0.7:  # a rewrite made for what stands there
        for path in draw.sample(places, len(places)):
            part = _at(tree, path)
            for rewrite in draw.sample(specific, len(specific)):
                new = rewrite(part, draw)
                if new is not None:
                    return _replaced(tree, path, new), rewrite.__name__
    path = draw.choice(places)
    part = _at(tree, path)
    if draw.random() < 0.2:
        name = draw.choice(REWRITES)
        return _replaced(tree, path, (name, part)), name
    rewrite = draw.choice(ANY_TREE)
    new = rewrite(part, draw)
    assert new is not None
    return _replaced(tree, path, new), rewrite.__name__
