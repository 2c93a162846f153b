"""Commands of Maple that are missing are told where they are used, and what came out of them is named."""

from symbody.worksheet import builtins
from symbody.worksheet.interpreter.interpret import Interpreter
from tests.worksheet.printed_by import failures, printed


def test_no_command_is_called_missing() -> None:
    known = {
        *builtins.KERNEL,
        *builtins.FORMS,
        *(name for each in builtins.PACKAGES.values() for name in each),
    }
    assert not builtins.MISSING & known


def test_a_missing_command_comes_back_with_a_note() -> None:
    interpreter = Interpreter()
    assert printed("eliminate({x+y=3},{x});", interpreter=interpreter) == ["eliminate({x+y = 3},{x})"]
    assert "eliminate of Maple is not there; it comes back unevaluated" in interpreter.session.notices


def test_what_a_package_does_not_have_is_told() -> None:
    interpreter = Interpreter()
    printed(
        "LinearAlgebra:-Detrminant(A); MBSymba_r6[kinetic_enrgy](b); f[1](x); g:-h(x);",
        interpreter=interpreter,
    )
    assert interpreter.session.notices == [
        "LinearAlgebra[Detrminant] is not known; it comes back unevaluated; did you mean Determinant?",
        "MBSymba_r6[kinetic_enrgy] is not known; it comes back unevaluated; did you mean kinetic_energy?",
        "the package g is not known; g:-h comes back unevaluated",
    ]


def test_a_function_of_a_symbol_may_be_a_command() -> None:
    interpreter = Interpreter()
    printed(
        "erf(u); kinetic_enrgy(B); erf(t); kinetic_enrgy(t); force(x); Trace(A);", interpreter=interpreter
    )
    assert interpreter.session.notices == [
        "erf of Maple is not there; it comes back unevaluated",
        "kinetic_enrgy is not a command; did you mean kinetic_energy?",
    ]


def test_a_command_of_a_package_that_is_not_loaded_is_told() -> None:
    interpreter = Interpreter()
    assert printed("M := diag(a, b);", interpreter=interpreter) == ["M := diag(a,b)"]
    (note,) = interpreter.session.notices
    assert note == (
        "diag is a command of linalg, which is not loaded; it comes back unevaluated: write with(linalg) before it, or "
        "linalg[diag]"
    )


def test_what_is_no_object_is_named() -> None:
    found = failures(
        "with(MBSymba_r6): comp_XYZ(eliminate([1,2])); comp_X([1]..2); comp_X(a=b); comp_X(true);"
    )
    kinds = [message.partition(" is ")[2].partition(";")[0] for message in found]
    assert kinds == ["a call that nobody knows, eliminate([1, 2])", "a range", "a relation", "a truth value"]


def test_levels_of_evaluation_are_told() -> None:
    interpreter = Interpreter()
    assert printed("a := b: b := 5: eval(a, 1);", interpreter=interpreter) == ["5"]
    assert interpreter.session.notices == [
        "eval(e, n): levels of evaluation are not counted; e is evaluated completely"
    ]
