"""How release 6 declares its commands: the parameters with their types and defaults, as Describe prints them."""

from __future__ import annotations

__all__ = ["SIGNATURES"]

_OBJECT = "obj::{BODY, FORCE, POINT, TORQUE, VECTOR} := NULL"
_ON = "BA::{BODY, mframe}, BR::{BODY, mframe} := master_frame"
_TRANSLATE = f"( x::scalar, y::scalar, z::scalar, {_OBJECT}, $ ) :: frame"
_ROTATE = f"( axis::{{VECTOR, symbol}}, angle::scalar, {_OBJECT}, $ ) :: frame"
_MOMENTS = ", ".join(f"{name}::scalar := 0" for name in ("Ix", "Iy", "Iz", "Cyz", "Cxz", "Cxy"))

SIGNATURES: dict[str, str] = {
    "Translate": _TRANSLATE,
    "translate": _TRANSLATE,
    "Rotate": _ROTATE,
    "rotate": _ROTATE,
    "inv_frame": "( TT::frame, $ ) :: frame",
    "set_frame_name": "( x::{frame, name}, nm::name )",
    "make_POINT": "( TT::frame, x::scalar, y::scalar, z::scalar, $ ) :: POINT",
    "origin": "( TT::frame, $ ) :: POINT",
    "make_VECTOR": "( TT::frame, u::scalar, v::scalar, w::scalar, $ ) :: VECTOR",
    "join_points": "( P::POINT, Q::POINT, $ ) :: VECTOR",
    "make_BODY": f"( T::{{POINT, frame}}, m::scalar, {_MOMENTS} )",
    "make_FORCE": f"( FF::VECTOR, PP::POINT, {_ON}, $ )",
    "make_TORQUE": f"( FF::VECTOR, {_ON}, $ )",
    "newton_equations": "( MBS::{set, list}, verbose::boolean := false, $ ) :: VECTOR",
    "euler_equations": "( MBS::{set, OBJECT, list}, AA::POINT := NULL, verbose::boolean := false, $ )",
}
"""The commands whose declaration is known; of others, Describe prints how they are called."""
