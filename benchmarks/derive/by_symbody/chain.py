"""A chain of rigid bodies in space."""

from __future__ import annotations

from collections.abc import Sequence

from symbody import Body, Expr, Point, System, Vector, functions_of_time, ground, rotate, symbols, translate


def system(axes: Sequence[str]) -> System:
    """Model the chain whose body i turns about the axes[i], such as "ZXY", one after the other."""
    frame, q, bodies = ground, list[Expr](), list[Body]()
    for i, body_axes in enumerate(axes, start=1):
        frame = frame * translate(*_parameters("px py pz", i))
        for axis in body_axes:
            q.append(functions_of_time(f"q{len(q) + 1}"))
            frame = frame * rotate(axis, q[-1])
        G = Point(frame, *_parameters("cx cy cz", i))
        bodies.append(Body(G, *_parameters("m Ix Iy Iz Cyz Cxz Cxy", i)))
    return System(bodies=bodies, coordinates=q, gravity=Vector(ground, 0, 0, -symbols("g")))


def _parameters(names: str, i: int) -> Sequence[Expr]:
    return [symbols(f"{name}{i}") for name in names.split()]
