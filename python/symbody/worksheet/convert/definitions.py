"""Functions that a program contains if it calls them."""

from __future__ import annotations

import re
from collections.abc import Iterator

__all__ = ["DEFINITIONS", "needed_definitions"]

_STATE_AT = '''def state_at(equations, motion, time):
    """Return the time and the state of a motion, by integration from its start up to a time."""
    state = motion.state_at(0)
    if time != motion.t[0]:
        span = motion.t[0], float(time)
        state = sb.simulate(equations, initial=state, t=span, rtol=1e-9, atol=1e-10).state_at()
    return {sb.t: time} | {x: state[x] for x in sorted(state, key=lambda x: (x.name, x.order))}
'''

_INDEXED = '''def indexed(name, *indices):
    """Return the function of time of a name with indices, such as theta[1]."""
    return sb.symbolic.time_function(f"{name}[{','.join(map(str, indices))}]")
'''

_EIGENVALUES = '''def eigenvalues(A, B=None):
    """Return the solutions s of A x = s B x, where B is the identity by default, in closed form."""
    s = sb.symbols("_s")
    B = sb.identity(A.shape[0]) if B is None else B
    return [each[s] for each in sb.solutions([(s*B - A).det()], [s])]
'''

_TIRE_FRAME = '''def tire_frame(wheel, road):
    """Return the frame of a tyre on a road with z downwards: x is ahead along the road, y the axis of the wheel."""
    surface = road*sb.rotate("X", sb.pi)
    x = sb.tire_kinematics(sb.Body(wheel, 0), 1, road=surface, spin_axis="-Y").longitudinal
    y = sb.Vector(wheel, 0, 1, 0)
    axes = [sb.project(each, road.ancestor).components for each in (x, y, sb.cross(x, y))]
    place = sb.project(sb.origin(wheel), road.ancestor).coordinates
    return road.ancestor*sb.Frame([*zip(*axes, place), (0, 0, 0, 1)])
'''

_CIRCLE = '''def circle(center, radius=1):
    """Return points of a circle."""
    x, y = map(float, center)
    angles = np.linspace(0, 2*np.pi, 49)
    return [[x + float(radius)*np.cos(a), y + float(radius)*np.sin(a)] for a in angles]
'''

_RECTANGLE = '''def rectangle(first, second):
    """Return the corners of a rectangle, of which two are given."""
    (a, b), (c, d) = first, second
    return [[a, b], [c, b], [c, d], [a, d], [a, b]]
'''

_LINES_IN = '''def lines_in(axes, shapes):
    """Draw shapes, which are lists of points; return the lines."""
    rows = [np.array(shape, dtype=float).T for shape in shapes]
    return [line for row in rows for line in axes.plot(*row, "o" if row.shape[1] == 1 else "-")]
'''

_AXES_OF = '''def axes_of(shapes):
    """Return equal axes in the plane or in space, as the points of shapes have two or three coordinates."""
    kind = "3d" if len(shapes[0][0]) == 3 else None
    axes = plt.figure().add_subplot(projection=kind)
    axes.set_aspect("equal")
    return axes
'''

_DRAW = '''def draw(shapes):
    """Draw shapes, which are lists of points, in one picture."""
    lines_in(axes_of(shapes), shapes)
'''

_ANIMATE = '''def animate(frames):
    """Return the animation of pictures, which are lists of shapes."""
    axes = axes_of(frames[0])
    animation = ArtistAnimation(axes.figure, [lines_in(axes, shapes) for shapes in frames])
    axes.figure.canvas.draw()  # begins it, also where no window shows it
    return animation
'''

DEFINITIONS: dict[str, str] = {
    "state_at": _STATE_AT,
    "indexed": _INDEXED,
    "eigenvalues": _EIGENVALUES,
    "tire_frame": _TIRE_FRAME,
    "circle": _CIRCLE,
    "rectangle": _RECTANGLE,
    "lines_in": _LINES_IN,
    "axes_of": _AXES_OF,
    "draw": _DRAW,
    "animate": _ANIMATE,
}
"""Their texts by their names; those that another one calls stand before it."""


def needed_definitions(body: str) -> Iterator[str]:
    """Return the functions that a program needs besides its own."""
    needed: set[str] = set()
    for name in reversed(DEFINITIONS):
        callers = [body, *(DEFINITIONS[each] for each in needed)]
        if any(re.search(rf"(?<![\w.]){name}\(", each) for each in callers):
            needed.add(name)
    yield from (text for name, text in DEFINITIONS.items() if name in needed)
