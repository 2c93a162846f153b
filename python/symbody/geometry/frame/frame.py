"""Frames: homogeneous transformations kept as chains of elementary motions."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from hashlib import blake2b
from typing import Annotated, NamedTuple, TypeAlias, final

from symbody.errors import FrameError
from symbody.geometry.component.triple import NULL, Scalar, Triple, triple
from symbody.geometry.component.twist import Twist
from symbody.geometry.given.argument import checked
from symbody.geometry.matrix.matrix_of_angles import least_distance
from symbody.geometry.matrix.orientation import (
    ROUGH,
    distance_from_rotation,
    largest_difference,
    nearest_rotation,
    report_rounding,
    turns,
)
from symbody.geometry.matrix.rounded_matrix import without_rounding
from symbody.geometry.motion.frame_motion import FrameMotion, Rows, Substitution
from symbody.geometry.motion.placement import Placement, is_rotation
from symbody.geometry.motion.principal_rotation import Rotation
from symbody.geometry.motion.translation import Translation
from symbody.symbolic import ENERGY, MOTION, Expr, Matrix, add3, derivation, dot3, latex, number, truncated
from symbody.symbolic.expression.container import Container, contains
from symbody.symbolic.expression.latex_layout import displayed
from symbody.symbolic.given.arguments import brief

Rows4: TypeAlias = Annotated[
    Matrix | Sequence[Sequence[Scalar]], "a 4x4 matrix: four rows of four entries each"
]


class Pose(NamedTuple):
    """A frame seen from its root: the rotation matrix by rows, and the origin."""

    rows: Rows
    origin: Triple


class Placing(NamedTuple):
    """A pose, and the last rotations about one axis that lead to it, with nothing but displacements between them.

    Attributes:
        pose: the pose.
        turn: the sum of these rotations; None if the last one is of another kind.
        before: the rows before them.
    """

    pose: Pose
    turn: FrameMotion | None
    before: Rows


@final
class Frame:
    """A frame of reference: ground, or a motion away from its parent.

    ``T1 * T2`` appends the motions of T2 to those of T1. Products share their common beginning, so that frames form
    the kinematic tree. A frame written as a 4x4 matrix is one general motion.

    Args:
        matrix: four rows of four entries: the rotation matrix, the origin in the last column, and 0, 0, 0, 1 in the
            last row.
        name: what the frame is called.

    >>> from symbody import functions_of_time, rotate, translate
    >>> x, phi = functions_of_time("x phi")
    >>> (translate(x, 0, 0) * rotate("Z", phi)).matrix[0, 3]
    x
    """

    __slots__ = ("carrier", "depth", "is_rigid", "key", "motion", "moves_by_twist", "name", "parent")

    parent: Frame | None
    motion: FrameMotion | None
    carrier: Twist | None
    """The twist of a moving master frame, whose pose is unknown."""
    is_rigid: bool
    moves_by_twist: bool
    """Whether the twist of this frame or of one before it is given, by speeds that are not rates of its pose."""
    depth: int
    key: bytes
    """A digest of the chain: equal for chains that place a frame in the same way."""
    name: str

    @checked(FrameError)
    def __init__(self, matrix: Rows4, *, name: str = "") -> None:
        frame = _from_matrix(_as_matrix(matrix))
        self._set(frame.parent, frame.motion, name)

    def _set(
        self, parent: Frame | None, motion: FrameMotion | None, name: str = "", carrier: Twist | None = None
    ) -> Frame:
        self.parent, self.motion, self.name, self.carrier = parent, motion, name, carrier
        if parent is None or motion is None:
            self.depth, self.is_rigid, self.moves_by_twist = 0, True, carrier is not None
            twist = () if carrier is None else (*carrier.angular, *carrier.linear)
            self.key = blake2b(b"".join(x.fingerprint for x in twist), digest_size=16).digest()
        else:
            self.depth, self.is_rigid = parent.depth + 1, parent.is_rigid and motion.is_rigid
            self.moves_by_twist = parent.moves_by_twist or motion.twist is not None
            self.key = blake2b(parent.key + motion.key, digest_size=16).digest()
        return self

    @classmethod
    def _make(
        cls, parent: Frame | None, motion: FrameMotion | None, name: str = "", carrier: Twist | None = None
    ) -> Frame:
        frame = cls.__new__(cls)
        return cls._set(frame, parent, motion, name, carrier)

    @classmethod
    def root(cls, name: str, carrier: Twist | None = None) -> Frame:
        """Return a frame without a parent."""
        return cls._make(None, None, name, carrier)

    def named(self, name: str) -> Frame:
        """Return the same frame under another name."""
        return Frame._make(self.parent, self.motion, name, self.carrier)

    # --- chains ---

    def then(self, motion: FrameMotion) -> Frame:
        """Return the frame reached from this one by one more motion."""
        if motion.is_identity:
            return self
        if self.parent is not None and self.motion is not None:
            merged = self.motion.merged(motion)
            if merged is not None:
                return self.parent.then(merged)
        return Frame._make(self, motion)

    def __mul__(self, other: Frame) -> Frame:
        if not isinstance(other, Frame):
            return NotImplemented
        if other.carrier is not None or other.ancestor.carrier is not None:
            raise FrameError(
                f"{brief(self)} * {brief(other)}: the second frame is attached to a moving master frame, whose place "
                "is unknown; put the moving frame first"
            )
        frame = self
        for motion in other.motions:
            frame = frame.then(motion)
        return frame

    __matmul__ = __mul__

    @property
    def chain(self) -> list[Frame]:
        """The frames from the root to this one."""
        frames = list(self._upwards())
        frames.reverse()
        return frames

    def _upwards(self) -> Iterator[Frame]:
        frame: Frame | None = self
        while frame is not None:
            yield frame
            frame = frame.parent

    @property
    def motions(self) -> list[FrameMotion]:
        """The motions from the root to this frame."""
        return [frame.motion for frame in self.chain if frame.motion is not None]

    @property
    def last_moving(self) -> Frame:
        """The frame after the last motion of the chain that is not constant, or the root; this frame is fixed in it."""
        frame = self
        while frame.parent is not None and frame.motion is not None and frame.motion.is_constant:
            frame = frame.parent
        return frame

    @property
    def ancestor(self) -> Frame:
        """The root of the chain: ground, or a moving master frame."""
        frame = self
        while frame.parent is not None:
            frame = frame.parent
        return frame

    @property
    def base(self) -> Frame:
        """The last frame of the chain up to which all motions are rigid."""
        frame = self
        while not frame.is_rigid and frame.parent is not None:
            frame = frame.parent
        return frame

    @property
    def coordinate_rates(self) -> dict[Expr, Expr]:
        """The coordinates in the chain whose rates are not speeds, and these rates by the speeds."""
        return {q: rate for motion in self.motions for q, rate in motion.coordinate_rates.items()}

    def inverse(self) -> Frame:
        """Return the inverse frame: ground as seen from this frame (by the transpose, if it isn't rigid)."""
        frame = ground
        for motion in reversed(self.motions):
            for back in motion.inverse():
                frame = frame.then(back)
        return frame

    def subs(self, substitution: Substitution) -> Frame:
        """Return the frame with expressions substituted."""
        frame = self.ancestor
        for motion in self.motions:
            frame = frame.then(motion.subs(substitution))
        return frame.named(self.name)

    def rewritten(self, variables: Sequence[Sequence[Expr]]) -> Frame:
        """Return the frame with the variables of each motion in other forms."""
        frame = self.ancestor
        for motion, values in zip(self.motions, variables, strict=True):
            frame = frame.then(motion.rewritten(values))
        return frame.named(self.name)

    # --- values ---

    @property
    def pose(self) -> Pose:
        """The rotation matrix and the origin, as seen from the root."""
        with derivation(order=ENERGY) as current:
            memo: dict[bytes, Placing] = current.cache.setdefault("pose", {})
            for link in frames_without_state(self, memo):
                if link.parent is None or link.motion is None:
                    memo[link.key] = UNMOVED
                else:
                    memo[link.key] = moved(link.motion, memo[link.parent.key])
            return memo[self.key].pose

    @property
    def matrix(self) -> Matrix:
        """The 4x4 matrix that takes coordinates to those in the root; of first order in small variables."""
        rows, origin = self.pose
        upper = [entry for row, place in zip(rows, origin, strict=True) for entry in (*row, place)]
        return Matrix.from_entries(
            4, 4, (*truncated(upper, MOTION), number(0), number(0), number(0), number(1))
        )

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Frame) and self.key == other.key

    def __hash__(self) -> int:
        return hash(self.key)

    @property
    def shown_motions(self) -> tuple[str, tuple[FrameMotion, ...]]:
        """The name of the last frame of the chain that has one, empty for ground, and the motions from there."""
        frame, motions = self, list[FrameMotion]()
        while not frame.name and frame.parent is not None and frame.motion is not None:
            motions.append(frame.motion)
            frame = frame.parent
        start = frame.name or ground.name
        if len(motions) > _SHOWN:
            return f"Frame({len(motions)} motions from {start})", ()
        return ("" if motions and frame == ground else start), tuple(reversed(motions))

    def __repr__(self) -> str:
        """Return the name, or the motions from the last frame that has a name."""
        start, motions = self.shown_motions
        return " * ".join([*([start] if start else []), *map(str, motions)])

    def _repr_latex_(self) -> str:
        return displayed(latex(self), name=self.name)


_SHOWN = 12
"""Motions of the longest chain that is shown."""

_AXES = triple(1, 0, 0), triple(0, 1, 0), triple(0, 0, 1)
UNMOVED = Placing(Pose(_AXES, NULL), None, _AXES)

ground = Frame.root("ground")

contains(
    Frame,
    Container(
        parts=lambda frame: [tuple(motion.variables) for motion in frame.motions],
        rebuilt=lambda frame, variables: frame.rewritten(variables),
        layout=lambda _, texts: texts[0],
        shown=lambda frame: [frame.matrix],
        advice="the matrix of a frame has one: diff(frame.matrix, x)",
        subs=lambda frame, mapping: frame.subs(mapping),
    ),
)


def frames_without_state(frame: Frame, memo: Mapping[bytes, object]) -> list[Frame]:
    """Return the frames from the root to a frame whose states are not in a memo yet, the outermost last.

    A recursion along chains gives each of them a state, by its motion and the state of its parent.
    """
    found = []
    current: Frame | None = frame
    while current is not None and current.key not in memo:
        found.append(current)
        current = current.parent
    return found[::-1]


def links_of(frames: Iterable[Frame]) -> list[Frame]:
    """Return the frames of the chains of some frames, each once, and parents before their children."""
    links: dict[bytes, Frame] = {}
    for frame in frames:
        links.update((link.key, link) for link in frames_without_state(frame, links))
    return list(links.values())


def moved(motion: FrameMotion, placing: Placing) -> Placing:
    """Return the placing reached by one more motion.

    Rotations about one axis add up. Where a variable drops out of their sum, the rows don't hold it.
    """
    (rows, origin), turn, before = placing
    x, y, z = rows
    d = motion.displacement
    origin = add3(origin, (dot3(x, d), dot3(y, d), dot3(z, d)))
    if not motion.rotates:
        return Placing(Pose(rows, origin), turn, before)
    total = None if turn is None else turn.merged(motion)
    if turn is None or total is None:
        return Placing(Pose(_turned(rows, motion), origin), motion, rows)
    is_shorter = total.leaves < turn.leaves | motion.leaves
    turned = _turned(before, total) if is_shorter else _turned(rows, motion)
    return Placing(Pose(turned, origin), total, before)


def _turned(rows: Rows, motion: FrameMotion) -> Rows:
    x, y, z = rows
    return motion.to_child(x), motion.to_child(y), motion.to_child(z)


def _as_matrix(matrix: Rows4) -> Matrix:
    result = matrix if isinstance(matrix, Matrix) else Matrix([list(row) for row in matrix])
    if result.shape != (4, 4):
        raise FrameError(
            f"Frame: a {result.rows}x{result.shape[1]} matrix, expected 4x4: the rotation, the origin in the last "
            "column, and 0, 0, 0, 1 in the last row"
        )
    last = result.entries[12:]
    if tuple(last) != (number(0), number(0), number(0), number(1)):
        raise FrameError(f"Frame: the last row is {', '.join(map(brief, last))}, expected 0, 0, 0, 1")
    return result


def _from_matrix(matrix: Matrix) -> Frame:
    e = matrix.entries
    rows, origin = ((e[0], e[1], e[2]), (e[4], e[5], e[6]), (e[8], e[9], e[10])), (e[3], e[7], e[11])
    if not all(entry.is_constant for row in rows for entry in row):
        exact = without_rounding(rows)
        _check_angles(exact)
        return ground.then(Placement(exact, origin))
    numbers = [[float(entry) for entry in row] for row in rows]
    defect = distance_from_rotation(numbers)
    if defect > ROUGH:
        raise FrameError(
            f"Frame: the rotation part isn't rigid: its rows are off a right-handed orthonormal triad by {defect:.3g}; "
            "give a rotation matrix, or build the frame with translate and rotate"
        )
    frame = ground.then(Translation(origin))
    for axis, angle in turns(nearest_rotation(numbers)):
        frame = frame.then(Rotation(axis, angle))
    if is_rotation(rows) and frame.pose.rows != rows:
        return ground.then(Placement(rows, origin))
    change = largest_difference([[float(entry) for entry in row] for row in frame.pose.rows], numbers)
    report_rounding(
        defect,
        "Frame: the rotation part is off a right-handed orthonormal triad",
        f"it was replaced by the nearest rotation, which changes entries by up to {change:.3g}; give all digits, or "
        "build the frame with translate and rotate",
    )
    return frame


def _check_angles(rows: Rows) -> None:
    distance = least_distance(rows)
    if distance > ROUGH:
        raise FrameError(
            "Frame: the rotation part isn't rigid: at some angles its rows are off a right-handed orthonormal triad by "
            f"{distance:.3g}; correct its sines and cosines, or build the frame with translate and rotate"
        )
