"""Tyres: the forces of the road on a wheel, with relaxation."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from inspect import signature
from typing import Annotated, NamedTuple, TypeAlias

from symbody.errors import ExpressionError, LoadError, ParameterError
from symbody.geometry import Frame, Scalar, ground
from symbody.geometry.component.triple import expression
from symbody.geometry.given.annotation import accepts
from symbody.geometry.given.argument import checked
from symbody.multibody.body import Body
from symbody.multibody.load import Action
from symbody.symbolic import (
    ENERGY,
    Abs,
    Expr,
    ExprLike,
    Max,
    derivation,
    functions_of_time,
    number,
    sign,
    sqrt,
    tanh,
)
from symbody.symbolic.given.arguments import brief, described

from .attachment import check_bodies, check_fixed, forces, not_negative, torques
from .element import Element, Undefined
from .linear_tire import LinearTire
from .magic_formula import MagicFormula
from .stored_energy import stored_energy
from .tire_coefficient import POSITIVE
from .tire_force import TireForce, TireLaw
from .tire_kinematics import Shape, SpinAxis, TireKinematics, tire_kinematics
from .tire_shape import TireShape

_WHERE = "tire"

_STANDS = (
    "stands still there along its direction of rolling (VS = 0), so that its slips are 0/0; give the tyre "
    "relaxation=(sigma_x, sigma_y), or a least_speed, or start with a vehicle that moves"
)

Law: TypeAlias = Annotated[
    TireLaw,
    "the law of a tyre, such as linear_tire(cornering=6e4), magic_formula(coefficients) or tire_file(path).law()",
]
Lengths: TypeAlias = Annotated[
    tuple[Scalar, Scalar] | list[Scalar], "two lengths, such as (0.1, 0.3): longitudinal and lateral"
]


@checked(LoadError)
def tire(
    wheel: Body,
    radius: Shape,
    law: Law,
    *,
    load: Scalar | None = None,
    load_acts: bool = False,
    stiffness: Scalar | None = None,
    damping: Scalar = 0,
    relaxation: Lengths | None = None,
    least_speed: Scalar = 0,
    crown_radius: Scalar = 0,
    rolling_radius: Scalar | None = None,
    road: Frame = ground,
    carrier: Frame | None = None,
    spin_axis: SpinAxis = "Y",
    reaction: Body | None = None,
    name: str = "",
) -> Element:
    """Return the forces of the road on a tyre, by a law of its load, slips and camber.

    The vertical load is given, or that of a spring and a damper which never pull: ``max(k d + c d', 0)`` for the
    deflection d. With relaxation lengths, the slips follow with a lag [Pacejka 2012, sec. 7.2.1]: they are states,
    whose rates are ``sigma kappa' = -(VS + VR) - |VS| kappa`` and ``sigma alpha' = VN - |VS| alpha``. Without, they are
    the ratios of velocities, which need a wheel that moves, or a `least_speed`.

    Args:
        wheel: the body that spins about the y axis of its frame.
        radius: the radius of the undeformed tyre, in m, or its shape (`tire_shape`).
        law: the law, such as `linear_tire` or `magic_formula` returns, or a `TireForce` whose components are given.
        load: the vertical load in N, where it is known, such as a parameter or the multiplier of a contact. The load
            itself then is no part of the forces: what holds the wheel on the road gives it.
        load_acts: whether a load that is given is part of the forces, such as that of a vertical spring of your own.
        stiffness: k, the vertical stiffness, in N/m, instead of a load.
        damping: c, the vertical damping, in N s/m.
        relaxation: the longitudinal and the lateral relaxation length, in m, such as those of a law by set 5.2.
        least_speed: v0, in m/s: ``sqrt(VS^2 + v0^2)`` stands for the speed |VS| in slips, and the rolling resistance
            fades below it; without, it changes its sign at rest.
        crown_radius: the radius of the cross section; zero for a thin disc.
        rolling_radius: the spin times this is the velocity of a wheel that rolls freely; by default the loaded radius.
        road: the frame whose x-y plane is the road, with z upwards; or the moving master frame that travels along it.
        carrier: a frame with x along the direction of rolling (`tire_kinematics`).
        spin_axis: "-Y" for a wheel whose y axis points to the right.
        reaction: the body that carries the road; none by default.
        name: what the tyre is called; its states are called ``kappa_name`` and ``alpha_name``.

    Returns:
        An element with the quantities "load", "kappa", "lateral_slip", "camber", "deflection", "Fx", "Fy", "Mx", "My",
        "Mz", "VS", "VN" and "VR", and the potential of the vertical spring, unless its stiffness or the radius is a
        function of time, such as a coordinate.

    >>> from symbody import Body, functions_of_time, linear_tire, rotate, symbols, translate
    >>> (y, psi), (R, C, N, V) = functions_of_time("y psi"), symbols("R C N V", positive=True)
    >>> from symbody import t
    >>> upright = translate(V * t, y, R) * rotate("Z", psi)
    >>> wheel = Body(upright, 1, name="wheel")
    >>> front = tire(wheel, R, linear_tire(cornering=C), load=N, carrier=upright, least_speed=V)
    >>> front["Fy"] == -C * front["lateral_slip"]
    True
    """
    check_bodies(_WHERE, wheel, reaction)
    check_fixed(_WHERE, "road", road, reaction)
    _check_load(load, stiffness, damping, acts=load_acts)
    sizes = not_negative(
        _WHERE,
        load=load,
        stiffness=stiffness,
        damping=damping,
        least_speed=least_speed,
        crown_radius=crown_radius,
    )
    with derivation(order=ENERGY):
        contact = tire_kinematics(
            wheel,
            radius,
            crown_radius=crown_radius,
            rolling_radius=rolling_radius,
            road=road,
            carrier=carrier,
            spin_axis=spin_axis,
        )
        vertical = _vertical(
            contact, load, 0 if stiffness is None else stiffness, damping, _shape(radius, crown_radius)
        )
        slip = _slips(contact, relaxation, expression(least_speed), name)
        _check_forces(law, stiffness, acts=load_acts)
        found = _rolling(law, contact, vertical.load, slip, expression(least_speed))
        carried = vertical.load if load is None or load_acts else number(0)
        actions = _actions(contact, found, carried, wheel, reaction)
    has_slips_at_rest = relaxation is not None or not expression(least_speed).is_zero
    return Element(
        _WHERE,
        actions,
        potential=vertical.potential,
        states=slip.states,
        quantities=_quantities(contact, found, vertical.load, slip),
        name=name,
        undefined=None if has_slips_at_rest else Undefined(contact.VS, _STANDS),
        sizes=sizes | _sizes(law, radius, rolling_radius, relaxation),
        positive=_POSITIVE,
        far_end=road if reaction is None else None,
    )


def _actions(
    contact: TireKinematics, found: TireForce, carried: Expr, wheel: Body, reaction: Body | None
) -> list[Action]:
    """Return the force at the contact and the moment about it.

    Args:
        contact: the contact, and its axes.
        found: the forces and moments in these axes.
        carried: the vertical load, if it is part of the force.
        wheel: the wheel.
        reaction: the body that carries the road, if there is one.
    """
    force = contact.longitudinal * found.longitudinal + contact.lateral * found.lateral
    if not carried.is_zero:
        force += contact.normal * carried
    moment = contact.longitudinal * found.overturning + contact.lateral * found.rolling
    moment += contact.normal * found.aligning
    actions = forces(force, contact.contact, wheel, reaction)
    if all(component.is_zero for component in moment.components):
        return actions
    return actions + torques(moment, wheel, reaction)


_POSITIVE = (
    "radius",
    "rolling_radius",
    "longitudinal relaxation",
    "lateral relaxation",
    *POSITIVE,
    "INFLPRES",
)
"""The sizes by which the kinematics or the law divide."""


def _sizes(
    law: TireLaw, radius: Shape, rolling_radius: Scalar | None, relaxation: Lengths | None
) -> dict[str, Expr]:
    """Return the sizes that must not be negative: radii, sizes in the law, and relaxation lengths."""
    wheel_radius = None if isinstance(radius, TireShape) else radius
    radii = not_negative(_WHERE, radius=wheel_radius, rolling_radius=rolling_radius)
    of_law = radii | (law.sizes if isinstance(law, LinearTire | MagicFormula) else {})
    if relaxation is None:
        return of_law
    along, across = relaxation
    lengths = {"longitudinal relaxation": along, "lateral relaxation": across}
    return of_law | not_negative(_WHERE, **lengths)


def _quantities(contact: TireKinematics, found: TireForce, load: Expr, slip: _Slips) -> dict[str, Expr]:
    return {
        "load": load,
        "kappa": slip.kappa,
        "lateral_slip": slip.alpha,
        "camber": contact.camber,
        "deflection": contact.deflection,
        "Fx": found.longitudinal,
        "Fy": found.lateral,
        "Mx": found.overturning,
        "My": found.rolling,
        "Mz": found.aligning,
        "VS": contact.VS,
        "VN": contact.VN,
        "VR": contact.VR,
    }


def _rolling(law: TireLaw, contact: TireKinematics, load: Expr, slip: _Slips, least: Expr) -> TireForce:
    """Return the forces on a wheel that rolls ahead or back, by a law of one that rolls ahead.

    Rolling resistance opposes the spin. The lateral force acts behind the contact as the wheel travels, so that the
    aligning moment of a wheel that travels back has the other sign; the arm of the longitudinal force stays.

    Args:
        law: the law.
        contact: how the wheel moves.
        load: the vertical load.
        slip: the slips.
        least: the speed below which directions are not told apart sharply, or zero.
    """
    if isinstance(law, TireForce):
        return _forces(law, load, slip, contact.camber)
    travel = _ahead(contact.VS, least)
    if isinstance(law, MagicFormula):
        speed = Abs(contact.VS) if law.needs_speed else None
        found = _forces(partial(law, speed=speed, ahead=travel), load, slip, contact.camber)
    else:
        found = _forces(law, load, slip, contact.camber)
        found = found._replace(aligning=found.aligning * travel)
    return found._replace(rolling=found.rolling * _ahead(-contact.VR, least))


def _ahead(velocity: Expr, least: Expr) -> Expr:
    """Return 1 for a velocity ahead, -1 for one back, and what is between up to a least speed."""
    return sign(velocity) if least.is_zero else tanh(velocity / least)


def _forces(law: TireLaw, load: Expr, slip: _Slips, camber: Expr) -> TireForce:
    """Return the forces by a law, which may be a function of the user's own."""
    arguments = (load, slip.kappa, slip.alpha, camber)
    try:
        signature(law).bind(*arguments)
    except TypeError as fault:
        raise LoadError(
            f"{_WHERE}: the law can't be called with four arguments ({fault}); expected a function of load, kappa, "
            "lateral_slip and camber"
        ) from None
    try:
        found = law(*arguments)
    except (TypeError, ArithmeticError, ExpressionError, ParameterError) as fault:
        raise LoadError(
            f"{_WHERE}: the law fails: {fault}; expected a function that takes symbols, such as lambda load, kappa, "
            "slip, camber: TireForce(0, -C*symbody.atan(slip)), with atan of symbody, not of math or numpy"
        ) from fault
    if not isinstance(found, TireForce):
        raise LoadError(
            f"{_WHERE}: the law returns {brief(repr(found))}; expected a TireForce, such as TireForce(Fx, Fy)"
        )
    for component, value in zip(TireForce._fields, found, strict=True):
        if not accepts(ExprLike, value):
            raise LoadError(
                f"{_WHERE}: in the TireForce that the law returns, {component} = {described(value)}; "
                "expected an expression, or a finite number"
            )
    return TireForce(*map(expression, found))


class _Vertical(NamedTuple):
    load: Expr
    potential: Expr | None


def _check_load(load: Scalar | None, stiffness: Scalar | None, damping: Scalar, *, acts: bool) -> None:
    if acts and load is None:
        raise LoadError(
            f"{_WHERE}: load_acts without load; expected load=N, or a stiffness, whose load always acts"
        )
    if (load is None) == (stiffness is None):
        given = "neither load nor stiffness" if load is None else "both load and stiffness"
        raise LoadError(
            f"{_WHERE}: {given}; expected the vertical load of the tyre, or the stiffness by which it follows from the "
            "deflection"
        )
    if stiffness is None and not expression(damping).is_zero:
        raise LoadError(
            f"{_WHERE}: damping = {brief(damping)} beside a load that is given; expected stiffness=k with it, or the "
            "damping within the load"
        )


def _check_forces(law: TireLaw, stiffness: Scalar | None, *, acts: bool) -> None:
    """Check that there is a force, and that those of a wheel that may lift off depend on its load."""
    if stiffness is None and not acts and isinstance(law, LinearTire) and law.has_no_forces:
        raise LoadError(
            f"{_WHERE}: the law has no stiffness, and a load that is given does not act, which leaves no force; "
            "expected linear_tire(cornering=C), stiffness=k for a wheel that carries alone, or load_acts=True"
        )
    if stiffness is not None and isinstance(law, LinearTire) and not (law.per_load or law.has_no_forces):
        raise LoadError(
            f"{_WHERE}: stiffness, with a linear tyre whose forces don't depend on the load, so that it would steer "
            "and brake in the air as well; expected linear_tire(..., per_load=True) with stiffnesses per load, or "
            "load=N for a wheel that stays on the road"
        )


def _vertical(
    contact: TireKinematics, load: Scalar | None, k: Scalar, c: Scalar, shape: Sequence[Expr]
) -> _Vertical:
    """Return the vertical load and its potential; a load that is given has none.

    Args:
        contact: the kinematics of the wheel.
        load: the load that is given.
        k: the vertical stiffness.
        c: the vertical damping.
        shape: sizes that must not depend on functions of time if there is to be a potential, besides the stiffness.
    """
    if load is not None:
        return _Vertical(expression(load), None)
    depth, damping = contact.deflection, expression(c)
    push = k * depth if damping.is_zero else k * depth + damping * contact.sinking
    return _Vertical(Max(push, 0), stored_energy(k * Max(depth, 0) ** 2 / 2, expression(k), *shape))


def _shape(radius: Shape, crown_radius: Scalar) -> tuple[Expr, ...]:
    """Return the radii, or the rates of deformation for a profile that depends on the camber."""
    if isinstance(radius, TireShape):
        return radius.y_rate, radius.z_rate
    return expression(radius), expression(crown_radius)


class _Slips(NamedTuple):
    kappa: Expr
    alpha: Expr
    states: dict[Expr, Expr]


def _slips(contact: TireKinematics, relaxation: Lengths | None, least: Expr, name: str) -> _Slips:
    speed = Abs(contact.VS) if least.is_zero else sqrt(contact.VS**2 + least**2)
    sliding = contact.VS + contact.VR
    if relaxation is None:
        if speed.is_zero:
            raise LoadError(
                f"{_WHERE}{f' {name}' if name else ''}: the contact never moves along its direction of rolling "
                "(VS = 0), so that its slips are 0/0; expected a carrier that travels, relaxation=(sigma_x, sigma_y), "
                "or a least_speed"
            )
        return _Slips(-sliding / speed, contact.VN / speed, {})
    if len(relaxation) != 2:
        raise LoadError(
            f"{_WHERE}: relaxation of {len(relaxation)} lengths; expected two, longitudinal and lateral, such as "
            "(0.1, 0.3)"
        )
    along, across = (expression(each) for each in relaxation)
    if not all(each.free_symbols or float(each) > 0 for each in (along, across)):
        raise LoadError(
            f"{_WHERE}: relaxation = ({along}, {across}); expected two positive lengths, or no relaxation: slips that "
            "follow at once need a least_speed, or a wheel that moves"
        )
    of = name.replace(" ", "_") or _WHERE
    kappa, alpha = functions_of_time(f"kappa_{of} alpha_{of}")
    rates = {kappa: (-sliding - speed * kappa) / along, alpha: (contact.VN - speed * alpha) / across}
    return _Slips(kappa, alpha, rates)
