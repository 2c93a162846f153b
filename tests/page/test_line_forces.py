"""Springs, dampers and actuators along lines: in long equations their lengths and forces have names."""

from __future__ import annotations

import re

import pytest

from symbody import (
    Body,
    Equations,
    Expr,
    Point,
    System,
    Vector,
    describe,
    floating_frame,
    functions_of_time,
    ground,
    line_force,
    moving_frame,
    newton_euler,
    parse,
    rotate,
    spring,
    symbols,
    t,
    translate,
)
from symbody.models import andrews_mechanism, full_car, slider_crank
from symbody.multibody.element.element import terms_of_law
from tests.repeated import repeated

m, k, c, l0, a, g, J = symbols("m k c l0 a g J")
x, y, z, theta = functions_of_time("x y z theta")


def on_struts(*places: tuple[Expr, Expr], law: str = "damped", letters: str = "x z theta") -> System:
    """Return a plate in a plane on a strut at each of the places, to the points below them on the ground."""
    first, second, angle = functions_of_time(letters)
    frame = translate(first, 0, second) * rotate("Y", angle)
    plate = Body(frame, m, 0, J)
    loads = []
    for i, (side, height) in enumerate(places):
        at, to = Point(frame, side, 0, height), Point(ground, side, 0, 0)
        if law == "given":
            loads.append(line_force(symbols(f"D{i}"), at, to, on=plate))
        else:
            free = 0 if law == "linear" else l0
            loads.append(spring(at, to, k, free_length=free, damping=c if law == "damped" else 0, on=plate))
    down = Vector(ground, 0, 0, -g)
    return System([plate], loads, [first, second, angle], gravity=down)


def in_symbols(equations: Equations) -> tuple[dict[str, Expr], list[Expr]]:
    """Return what the names in the text of equations stand for, and the rows as residuals."""
    names = {leaf.name: leaf for leaf in equations.system.leaves}
    names |= {each.name: each for each in (*equations.speeds, *equations.system.multipliers)}
    names |= {each.name: each for each in equations.coordinates}
    defined, residuals = dict[str, Expr](), list[Expr]()

    def value(text: str) -> Expr:
        for name in defined:
            text = re.sub(rf"\b{name}'", f"{name}_rate", text)
        return parse(text, names)

    for row in re.split(r"\n    (?! )", describe(equations))[1:]:
        text = row.replace("\n", " ")
        if " := " in text:
            name, right = text.strip().split(" := ")
            defined[name] = value(right)
            names |= {name: defined[name], f"{name}_rate": defined[name].diff(t)}
        elif not text.startswith(("constraint", "kinematics")):
            left, right = text.split(" = ")
            residuals.append(value(left) - value(right))
    return defined, residuals


STRUTS = [(a, m / k), (-a, c / k), (a / 2, l0)]


@pytest.mark.parametrize("law", ["damped", "given", *repeated(["elastic"])])
def test_rows_with_names_are_the_equations(law: str) -> None:
    equations = newton_euler(on_struts(*STRUTS, law=law))
    defined, residuals = in_symbols(equations)
    assert {"l1", "l2", "l3"} <= {*defined}
    assert ("F1" in defined) == (law != "given")
    assert tuple(residuals) == equations.residuals


@pytest.mark.parametrize("model", [full_car, slider_crank, andrews_mechanism])
def test_rows_of_models_with_names_are_the_equations(model: object) -> None:
    equations = newton_euler(model().system)  # type: ignore[operator]
    defined, residuals = in_symbols(equations)
    assert defined
    assert tuple(residuals) == equations.residuals


def test_a_car_on_four_struts_fits_a_page() -> None:
    """A strut stands in each row as its force, its lever and its length."""
    text = describe(newton_euler(full_car().system))
    assert text.count("\n") < 45
    assert "\n    F1 := cf*l1' " in text
    assert "F1*(z - z1 + h - a*sin(theta) + 1/2*w*cos(theta)*sin(phi))/l1" in text


@pytest.mark.parametrize(
    ("letters", "length", "force"),
    [("l z theta", "d", "F"), ("d1 l F_a", "L", "f"), *repeated([("x z theta", "l", "F")])],
)
def test_names_look_like_none_of_the_model(letters: str, length: str, force: str) -> None:
    system = on_struts(*STRUTS, letters=letters)
    names = re.findall(r"^    (\w+) :=", describe(newton_euler(system)), re.MULTILINE)
    assert {f"{length}{i}" for i in (1, 2, 3)} | {f"{force}{i}" for i in (1, 2, 3)} <= {*names}


def test_springs_without_direction_need_no_names() -> None:
    """Their force is k times the vector between their ends."""
    assert ":=" not in describe(newton_euler(on_struts(*STRUTS, law="linear")))


def test_short_equations_have_no_names() -> None:
    bob = Body(translate(x, y, 0), m)
    band = spring(bob.center_of_mass, Point(ground, a, 0, 0), k, free_length=l0, on=bob)
    assert ":=" not in describe(newton_euler(System([bob], [band], [x, y])))


def free_masses(names: str, parameters: str, *, is_damped: bool) -> System:
    """Return two masses in a vertical plane: the first hangs on the ground by a spring, the second on the first."""
    first, second = functions_of_time(names)[:2], functions_of_time(names)[2:]
    k1, k2, a1, a2, c1 = symbols(parameters)
    upper, lower = (
        Body(translate(*place, 0), mass)
        for place, mass in zip((first, second), symbols("m1 m2"), strict=True)
    )
    hanging = spring(
        upper.center_of_mass,
        Point(ground, 0, 0, 0),
        k1,
        free_length=a1,
        damping=c1 if is_damped else 0,
        on=upper,
    )
    joint = spring(lower.center_of_mass, upper.center_of_mass, k2, free_length=a2, on=lower, reaction=upper)
    return System([upper, lower], [hanging, joint], [*first, *second], gravity=Vector(ground, 0, -g, 0))


@pytest.mark.parametrize("is_damped", [False, True])
def test_free_masses_on_springs_with_free_lengths(is_damped: bool) -> None:
    """Books write `k2*(x2 - x1)*(1 - a2/l2)`: 214 and 270 characters with the definitions of l1 and l2."""
    forms = []
    for names, parameters in (("x1 y1 x2 y2", "k1 k2 a1 a2 c1"), ("u v w z", "p q a b c")):
        equations = newton_euler(free_masses(names, parameters, is_damped=is_damped))
        defined, rows = in_symbols(equations)
        assert {"l1", "l2"} <= {*defined}
        assert [*equations.residuals] == rows
        forms.append(re.sub(r"\b[a-z]\d?\b", "_", describe(equations).partition("\n")[2]))
    assert len(re.sub(r"\s", "", forms[0])) <= 1.1 * (270 if is_damped else 214)
    assert forms[0] == forms[1]


@pytest.mark.parametrize("count", [1, 2, 3])
def test_each_spring_is_a_term_of_its_own(count: int) -> None:
    """`k*y*(1 - l0/l1)`: what springs of one stiffness have in common is not taken out; one short root has no name."""
    mass = Body(translate(x, y, 0), m)
    ends = [Point(ground, *place, 0) for place in ((-a, 0), (a, 0), (0, a))[:count]]
    bands = [spring(mass.center_of_mass, end, k, free_length=l0, on=mass) for end in ends]
    equations = newton_euler(System([mass], bands, [x, y]))
    text = describe(equations)
    assert text.count(" k*") == 2 * count
    assert text.count(":= sqrt(") == (count if count > 1 else 0)
    assert in_symbols(equations)[1] == [*equations.residuals]


def test_a_damper_between_free_points_has_the_rate_of_its_length() -> None:
    """`c*x*l'/l`, and no term for each speed."""
    mass = Body(translate(x, y, 0), m)
    damper = spring(mass.center_of_mass, Point(ground, 0, 0, 0), 0, damping=c, on=mass)
    equations = newton_euler(System([mass], [damper], [x, y]))
    assert "m*x'' + c*x*l'/l = 0" in describe(equations)
    assert in_symbols(equations)[1] == [*equations.residuals]


@pytest.mark.parametrize("has_damper", [False, True])
def test_a_length_has_one_form(has_damper: bool) -> None:
    """A spring on a bob that swings from a slider: the matrix form has the same terms as the rows."""
    bob = Body(Point(translate(x, 0, 0) * rotate("Z", theta), 0, -a, 0), m)
    band = spring(
        bob.center_of_mass,
        Point(ground, 0, 0, 0),
        k,
        free_length=l0,
        damping=c if has_damper else 0,
        on=bob,
        name="band",
    )
    equations = newton_euler(System([bob], [band], [x, theta]))
    roots = set(re.findall(r"sqrt\(.*?\)\)", describe(equations) + equations.matrix_form().description()))
    assert len(roots) <= 1
    assert in_symbols(equations)[1] == [*equations.residuals]


def test_a_long_root_that_stands_twice_has_a_name() -> None:
    """Two pendulums side by side, joined by a spring with a free length."""
    first, second = functions_of_time("q1 q2")
    bobs = [
        Body(translate(a * i, 0, 0) * rotate("Z", q) * translate(0, -c, 0), m)
        for i, q in enumerate((first, second))
    ]
    joint = spring(
        bobs[0].center_of_mass, bobs[1].center_of_mass, k, free_length=l0, on=bobs[0], reaction=bobs[1]
    )
    equations = newton_euler(System(bobs, [joint], [first, second]))
    text = describe(equations)
    assert text.count("sqrt(") == 1
    assert "F := k*(l - l0)" in text
    _, rows = in_symbols(equations)
    assert [*equations.residuals] == rows


@pytest.mark.filterwarnings("error")
def test_names_of_the_page_are_no_namesakes_of_the_users() -> None:
    """The user has symbols l, L and F in the same file, of which the model has l: no notice, and no second meaning."""
    l, _, _ = symbols("l L F")
    bobs = [
        Body(translate(a * i, 0, 0) * rotate("Z", q) * translate(0, -l, 0), m)
        for i, q in enumerate(functions_of_time("q1 q2"))
    ]
    ends = [bob.center_of_mass for bob in bobs]
    joint = spring(*ends, k, free_length=l0, on=bobs[0], reaction=bobs[1], name="band")
    system = System(bobs, [joint], functions_of_time("q1 q2"))
    assert "F := k*(" in describe(newton_euler(system))
    assert "l := " not in describe(newton_euler(system))
    assert terms_of_law(joint, {"l"}) == (k * (functions_of_time("length") - l0),)


def test_a_force_along_an_axis_is_shown_by_a_sign() -> None:
    """`k*(z + a - b*sign(z + a))` and no quotient of the length by itself."""
    ball = Body(translate(0, 0, z), m)
    band = spring(ball.center_of_mass, Point(ground, 0, 0, -a), k, free_length=l0, on=ball)
    (row,) = describe(newton_euler(System([ball], [band], [z]))).splitlines()[1:]
    assert row.strip() == "m*z'' + k*(z + a - l0*sign(z + a)) = 0"


@pytest.mark.parametrize("is_floating", [True, False])
def test_lines_on_bodies_with_speeds_of_their_own(is_floating: bool) -> None:
    """The slopes are by the speeds; the matrix form has the loads themselves."""
    if is_floating:
        frame, speeds = floating_frame(), []
    else:
        u, v, r = functions_of_time("u v r")
        frame, speeds = (
            moving_frame(u, v, 0, 0, 0, r, pose=translate(x, y, 0) * rotate("Z", theta)),
            [u, v, r],
        )
    hull = Body(frame, m, J, J, J)
    lines = [
        spring(Point(frame, a, side, 0), Point(ground, a, 2 * side, 0), k, free_length=l0, damping=c, on=hull)
        for side in (a, -a)
    ]
    equations = newton_euler(System([hull], lines, speeds=speeds))
    text = describe(equations)
    assert "l1 := " in text
    assert max(map(len, text.splitlines())) <= 110
    form = equations.matrix_form()
    assert "l1 := " in form.description()
    assert r"l_{1} &= " in form.latex()
    assert not any(leaf.name in {"l1", "F1"} for entry in form.loads.entries for leaf in entry.free_symbols)
