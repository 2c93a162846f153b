"""Translation: a displacement without rotation."""

from __future__ import annotations

from collections.abc import Sequence
from typing import final

from symbody.geometry.component.triple import NULL, Rate, Triple, is_null
from symbody.symbolic import Expr, number, scale3

from .frame_motion import FrameMotion, Substitution


@final
class Translation(FrameMotion):
    """A displacement along the parent's axes."""

    tag = b"translation"
    rotates = False
    displacement: Triple = NULL

    def __init__(self, displacement: Triple) -> None:
        self.displacement = displacement

    @property
    def variables(self) -> tuple[Expr, ...]:
        return self.displacement

    def to_parent(self, v: Triple) -> Triple:
        return v

    def to_child(self, v: Triple) -> Triple:
        return v

    def spin(self, rate: Rate) -> Triple:
        del rate
        return NULL

    def inverse(self) -> tuple[FrameMotion, ...]:
        return (Translation(scale3(number(-1), self.displacement)),)

    def subs(self, substitution: Substitution) -> FrameMotion:
        x, y, z = self.displacement
        return Translation((x.subs(substitution), y.subs(substitution), z.subs(substitution)))

    def rewritten(self, variables: Sequence[Expr]) -> FrameMotion:
        x, y, z = variables
        return Translation((x, y, z))

    def __repr__(self) -> str:
        return f"translate({', '.join(map(str, self.displacement))})"

    def in_latex(self, variables: Sequence[str]) -> str:
        return rf"\mathrm{{Trans}}\left({', '.join(variables)}\right)"

    def merged(self, following: FrameMotion) -> FrameMotion | None:
        """Merge only translations that cancel: any other sum would hide the frame in between, which may be shared."""
        if type(following) is not Translation:
            return None
        pairs = zip(self.displacement, following.displacement, strict=True)
        return Translation(NULL) if all((a + b).is_zero for a, b in pairs) else None

    @property
    def is_identity(self) -> bool:
        return is_null(self.displacement)
