"""Names of SymPy, NumPy and MBSymba lead to ours, which exist."""

from __future__ import annotations

import re

import pytest

import symbody
from symbody import Matrix, Piecewise, symbols
from symbody.errors import ArgumentError
from symbody.symbolic.given.hint import _HINTS

x, k = symbols("x k")
A = Matrix([[x, 1]])
OWNERS = {"symbody": symbody, "Expr": x, "Matrix": A}
NAMES = [(owner, name) for owner, hints in _HINTS.items() for name in hints]


@pytest.mark.parametrize(("owner", "name"), NAMES)
def test_a_name_of_others_leads_to_ours(owner: str, name: str) -> None:
    with pytest.raises(AttributeError) as caught:
        getattr(OWNERS[owner], name)
    hint = _HINTS[owner][name]
    assert str(caught.value) == f"{owner} has no {name!r}; here it is {hint}"
    for called in re.findall(r"(?<![.\w])([A-Za-z]\w*)\(", hint):
        assert called in {"float", "print", "list"} or hasattr(symbody, called), called
    for of, attribute in re.findall(r"\b([eA])\.(\w+)", hint):
        assert hasattr({"e": x, "A": A}[of], attribute), attribute


def test_other_names_are_unknown() -> None:
    for owner, thing in OWNERS.items():
        with pytest.raises(AttributeError, match=f"^{owner} has no 'nonsense'$"):
            thing.nonsense  # noqa: B018
        assert not hasattr(thing, "_ipython_canary_method_should_not_exist_")
        assert getattr(thing, "nonsense", None) is None


def test_properties_keep_their_own_errors() -> None:
    with pytest.raises(AttributeError, match=r"^this expression has no name$"):
        (x + k).name  # noqa: B018
    with pytest.raises(AttributeError, match=r"^only functions of time have an order$"):
        x.order  # noqa: B018


def test_two_arguments_of_subs() -> None:
    with pytest.raises(ArgumentError) as caught:
        x.subs(x, 1)  # type: ignore[arg-type]
    assert (
        str(caught.value)
        == "subs takes one mapping of variables to their values: subs({x: 1}), not subs(x, 1)"
    )


def test_a_last_branch_may_always_hold() -> None:
    assert Piecewise((k * x, x), (1, True)) == Piecewise((k * x, x), otherwise=1)
    assert Piecewise((k, True)) == k
    with pytest.raises(ArgumentError, match="Piecewise: True is a bool"):
        Piecewise((1, True), (2, x))
