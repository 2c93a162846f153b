"""Statements whose program hung, was lost, or was other than the worksheet."""

from __future__ import annotations

import argparse
import re
from pathlib import Path
from typing import Any

import pytest

import symbody as sb
from symbody.worksheet.convert import convert_file
from symbody.worksheet.convert.program import Converted, converted
from symbody.worksheet.reading.files import source_cells

pytestmark = pytest.mark.filterwarnings("ignore::symbody.errors.ModelNotice")
"""Other tests of this process use the names of these sheets for other things."""


def made(text: str) -> tuple[Converted, dict[str, Any]]:
    program, values = converted(source_cells(text), "statements"), dict[str, Any]()
    exec(program.text, values)
    return program, values


@pytest.mark.parametrize(
    ("head", "total"),
    [
        ("for i while i < 4", 1 + 2 + 3),
        ("for i from -1 while i < 2", -1 + 0 + 1),
        ("for i by 2 while i < 6", 1 + 3 + 5),
        ("for i from 5 by -2 while i > 0", 5 + 3 + 1),
        ("for i to 9 while i < 3", 1 + 2),
    ],
)
def test_loops_that_a_condition_ends_count(head: str, total: int) -> None:
    program, values = made(f"i := -7: s := 0: {head} do s := s + i end do: f := s:")
    assert (program.values, program.left_out) == (0, 0)
    assert values["f"] == total


def test_modules_of_the_program_outlive_a_restart() -> None:
    text = (
        "restart: P := proc(n) option remember; n + 1 end: a := P(3): "
        "s := 0: for i while i < 3 do s := s + i end do:"
    )
    program, values = made(text)
    assert (program.values, program.left_out) == (0, 0)
    assert (values["a"], values["s"]) == (4, 3)
    assert "@functools.cache\ndef P(n):" in program.text


def test_names_with_a_value_before_a_restart_are_symbols_in_all_lines_behind_it() -> None:
    """Also in lines that give a value, and as small variables; at the head, b would say nothing."""
    program, values = made(
        "b := 3: m := 7: e := b*m: restart: with(MBSymba_r6): linear_modeling({a(t),b(t)}): "
        "T := rotate('X',a(t))*rotate('Y',b(t)): restart: g := linearize(m^2,{m=k}):"
    )
    assert (program.values, program.left_out) == (1, 0)
    head, _, rest = program.text.partition("b = 3\n")
    assert "b" not in re.findall(r"\w+", head.rpartition("import")[2])
    assert '\nb = sb.functions_of_time("b")\na, b = sb.small(a, b)\n' in rest
    b, k, m = values["b"], sb.symbols("k"), sb.symbols("m")
    assert (values["e"], values["g"]) == (21, 2 * k * m - k**2)
    assert sb.diff(b, sb.t) == sb.angular_velocity(values["T"]).components[1]


def test_names_of_modules_are_variables_of_the_worksheet() -> None:
    _, values = made("Path := 3: itertools := 4: pickle := Path + itertools: s := pickle:")
    assert values["s"] == 7


def test_statements_that_fail_are_counted(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    sheet = tmp_path / "a.mpl"
    sheet.write_text("P := proc(x::posint) x end:\nP(0);\ny := 2;\n", encoding="utf-8")
    assert convert_file(argparse.Namespace(file=sheet, program=tmp_path / "a.py")) == 1
    assert capsys.readouterr().out == "2 statements written as code, 0 as values, 0 left out, 1 failed\n"


def test_cases_of_values_declare_no_truth() -> None:
    program, values = made("z := piecewise(x < 1, 2, 3);")
    assert "True_" not in program.text
    assert values["z"].subs({values["x"]: 0}) == 2
    assert values["z"].subs({values["x"]: 4}) == 3


def test_formats_have_texts_and_numbers(capsys: pytest.CaptureFixture[str]) -> None:
    program, _ = made(
        r'for i to 2 do printf("%s = %+06.3f%% of %a\n", cat("F", i), evalf(i*Pi), x + i) end do;'
    )
    assert (program.values, program.left_out) == (0, 0)
    assert capsys.readouterr().out == "F1 = +3.142% of x + 1\nF2 = +6.283% of x + 2\n"


def test_types_of_parameters_are_tested() -> None:
    program, found = made(
        "f := proc(k::positive, x::list(algebraic), B::{POINT,BODY}, n::posint := 2) k*x[1]*n end proc:\n"
        "a := f(3/2, [y], make_POINT(ground,0,0,l)):\n"
        'try f(-1, [y], origin(ground)) catch "invalid": b := 1 end try:\n'
    )
    assert (program.values, program.left_out) == (0, 0)
    point, y = sb.origin(sb.ground), sb.symbols("y")
    assert found["a"] == 3 * y
    assert found["b"] == 1
    for arguments, message in [
        ((0, [y], point), "f: k is 0; expected positive"),
        ((1, [point], point), f"f: x is [{point!r}]; expected list(algebraic)"),
        ((1, [y], y), "f: B is y; expected {POINT, BODY}"),
        ((1, [y], point, 2.5), "f: n is 2.5; expected posint"),
    ]:
        with pytest.raises(ValueError, match=re.escape(message)) as raised:
            found["f"](*arguments)
        assert str(raised.value) == message


@pytest.mark.parametrize(
    ("sheet", "printed", "values"),
    [
        ("for i to 2 do i*x; if i > 1 then i end if end do;", "x\n2*x\n", 0),  # printlevel is 1
        ('f := proc(x) print(x^2); printf("%d,", x); x end proc: y := f(3):', "9\n3,", 0),
        (
            "y := q + a: for n to 2 do q := n*b; y; end do;",
            "a + b\na + 2*b\n",
            0,
        ),  # y is another value each time
        ('y := q: for n to 2 do q := n; printf("%d,", y) end do:', "1,2,", 0),
    ],
)
def test_programs_print_what_loops_and_procedures_print(
    sheet: str, printed: str, values: int, capsys: pytest.CaptureFixture[str]
) -> None:
    assert made(sheet)[0].values == values
    assert capsys.readouterr().out == printed


def test_operators_on_items_are_written_for_the_items() -> None:
    program, found = made(
        "L := [[0,3/2],[2,1],[4,2]]: a := map(x -> x[2], L): m := max(map(x -> x[2], L)): b := x:\n"
        "w := op(select(x -> x[2] = m, L)): r := remove(x -> x[1] > 1, L): z := map(u -> u*x, [x, y]):\n"
        "A := map(u -> u^2, Matrix([[1, x], [y, 2]])):\n"
    )
    assert (program.values, program.left_out) == (0, 0)
    assert "a = [x[1] for x in L]\n" in program.text
    x, y = sb.symbols("x y")
    assert (found["m"], found["w"], found["z"]) == (2, [4, 2], [x**2, x * y])
    assert found["r"] == [[0, sb.number("3/2")]]
    assert found["A"] == sb.Matrix([[1, x**2], [y**2, 4]])


def test_loops_by_decimals_reach_their_end(capsys: pytest.CaptureFixture[str]) -> None:
    program, _ = made('for T from 0 to 1 by 0.1 do printf("%4.1f", T) end do: 2 in {1,2};')
    assert (program.values, program.left_out) == (0, 0)
    assert capsys.readouterr().out == "".join(f"{k / 10:4.1f}" for k in range(11)) + "True\n"


def test_aliases_and_inequalities_of_constants_are_written() -> None:
    program, found = made(
        "alias(c = cos): alias(al = alpha(t)): e := R*c(al): w := diff(al, t)*al; if sqrt(2) - 1 < 1/3 then r := 1 "
        "else r := 2 fi: S := solve({2*diff(al, t) = x}, {diff(al, t)}): U := convert(S, set): f := unapply(t^2*x, t): "
        "A := convert(matrix(2, 2, [[1, x], [2, 3]]), listlist): 1 + f(3): subs(x = 1, %): k := % + 1:"
    )
    assert (program.values, program.left_out) == (0, 0)
    alpha, x = sb.function("alpha")(sb.t), sb.symbols("x")
    assert (found["e"], found["r"], found["k"]) == (sb.symbols("R") * sb.cos(alpha), 2, 11)
    assert found["U"] == {sb.diff(alpha, sb.t): x / 2}
    assert found["A"] == [[1, x], [2, 3]]


def test_eigenvalues_are_a_sequence_whose_parts_are_taken() -> None:
    program, found = made(
        "ev := [linalg[eigenvals](matrix(2, 2, [[0, 1], [-4, 0]]))]: n := nops(select(x -> Im(x) > 0, ev)): "
        "w := max(op(map(Im, evalf(ev)))): S := fsolve({x + y = 3, x*y = 2}, {x, y}, {x = 0..1.2, y = 1.5..3}): "
        "V := fsolve({x + y = 3, x*y = 2}, S):"
    )
    assert (program.values, program.left_out) == (0, 0)
    assert (found["n"], round(found["w"], 9)) == (1, 2)
    x, y = sb.symbols("x y")
    for each in (found["S"], found["V"]):
        assert [round(each[name], 9) for name in (x, y)] == [1, 2]


def test_sets_have_no_repeated_items() -> None:
    program, found = made(
        "S := {seq(k mod 3, k = 1..7)}: n := nops(S): U := {a, b} union {b, c}: m := nops(U):"
    )
    assert (program.values, program.left_out) == (0, 0)
    assert (found["n"], found["m"]) == (3, 3)


def test_procedures_are_called_for_what_they_change(capsys: pytest.CaptureFixture[str]) -> None:
    """Tables are passed as such, and names of the sheet are global; a value that nobody sees is not computed."""
    made = converted(
        source_cells(
            "init := proc(tab) tab[k] := 4; NULL end: par := table(): init(par): par[k]; "
            "count := 0: step := proc() global count; count := count + 1; NULL end: step(): step(); count; "
            "g := proc(x) x^2 end: g(3): alias(c = cos): H := -c*v:"
        ),
        "tables",
    )
    assert (made.values, made.left_out) == (0, 0)
    exec(made.text, {})
    assert capsys.readouterr().out == "4\n2\n"


def test_code_has_the_names_and_the_brackets_of_its_language(capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("sympy")
    made = converted(
        source_cells(
            "CodeGeneration[Matlab]([s1 = a*b, y[3] = a^2]): with(CodeGeneration): Matlab(<x, x*y>, resultname = "
            '"V"): C([a, b]): C([u[1] = a*b]): Fortran([a, 2*b]):'
        ),
        "code",
    )
    assert (made.values, made.left_out) == (0, 0)
    exec(made.text, {})
    lines = [line.strip() for line in capsys.readouterr().out.splitlines()]
    assert lines == [
        *("s1 = a.*b;", "y(3) = a.^2;", "V = [x; x.*y];", "cg[0] = a;", "cg[1] = b;", "u[0] = a*b;"),
        *("cg(1) = a", "cg(2) = 2*b"),
    ]


def test_cases_texts_and_parts_of_solutions_are_code(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    program, found = made(
        "with(StringTools): F := piecewise(t <= 1, 5, t < 2 and a > 0, 7, 9):\n"
        's := sprintf("%4.2f %s", Pi, UpperCase("ab")): n := length(s): evalf[3](2*Pi);\n'
        "seq(`if`(i mod 2 = 0, i^2, NULL), i = 1..4);\n"
        "w := solve({u(t) = 2*sin(q(t)), v(t) = u(t)}, {u(t), v(t)}): w := map(simplify, w):\n"
        "K := simplify(u(t)^2, {u(t) - p(t)}, [u(t)]): has(diff(q(t), t), q(t));\n"
        'd := [3, 4]: save d, s, "data.mpl": d := \'d\': read "data.mpl": d[2];\n'
    )
    assert (program.values, program.left_out) == (0, 0)
    a, q, p = sb.symbols("a"), *sb.functions_of_time("q p")
    for time, sign, expected in [(1, 1, 5), (1.5, 1, 7), (1.5, -1, 9), (2, 1, 9)]:
        assert found["F"].evaluate({sb.t: time, a: sign}) == expected
    assert (found["s"], found["n"], found["K"]) == ("3.14 AB", 7, p**2)
    assert found["w"] == {each: 2 * sb.sin(q) for each in sb.functions_of_time("u v")}
    assert capsys.readouterr().out == "6.28\n[4, 16]\nTrue\n4\n"


def test_files_with_procedures_are_part_of_the_program(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "lib.mpl").write_text(
        "rod := proc(T) local v; v := make_POINT(T, l, 0, 0); if nargs > 1 then make_BODY(v, args[2])"
        " else make_BODY(v, m) fi end:\n"
        'fact := proc(n) if n < 0 then error "n is %1", n fi; if n = 0 then 1 else n*procname(n-1) fi end:\n'
        "unused := proc(B) local A; A := copy(B); A[mass] := 0; A end:\nk := 4;\n"
    )
    sheet = tmp_path / "a.mpl"
    sheet.write_text(
        'with(MBSymba_r6): read "lib.mpl":\n'
        "B := rod(translate(v(t), 0, 0)): C := rod(ground, 2*m): kinetic_energy({B, C}); fact(k);\n"
        "for c in [2, 4] do print(c, linalg[matrix](1, 1, [c*I + 1])) od:\n"
    )
    assert convert_file(argparse.Namespace(file=sheet, program=tmp_path / "a.py")) == 0
    text = (tmp_path / "a.py").read_text()
    assert "    v = sb.Point(T, l, 0, 0)" in text
    assert "raise ValueError(f'n is {n}')" in text
    assert "    return n*fact(n - 1)" in text
    assert "# left out: unused" in text
    capsys.readouterr()
    exec(text, {})
    assert capsys.readouterr().out.splitlines() == ["m*v'**2/2", "24", "2", "[[1.+2.j]]", "4", "[[1.+4.j]]"]


def test_percent_signs_of_formats_are_single(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    program, _ = made(
        'f := fopen("a.m", WRITE): fprintf(f, "%% by hand\\n"): fprintf(f, "%5.2f%%\\n", Pi): fclose(f):\n'
        'printf("50%%\\n");'
    )
    assert (program.values, program.left_out) == (0, 0)
    assert (tmp_path / "a.m").read_text() == "% by hand\n 3.14%\n"
    assert capsys.readouterr().out == "50%\n"


def test_a_radius_of_a_tyre_that_changes_leaves_the_road_at_rest() -> None:
    program, found = made(
        "with(MBSymba_r6): use_moving_frame(u(t), 0, 0, 0, 0, 0):\n"
        "wheel := make_BODY(translate(0,0,-h)*rotate('X',phi(t))*rotate('Y',theta(t)), m):\n"
        "tire := make_TIRE(wheel, 0, 0, 0, 0, rr(t), X, 0, -N, 0, 0, 0, moving_frame):\n"
        "(C, VS, VN, VR) := tire_kinematics(tire): camber := rhs(tire['angles'][2]):\n"
    )
    assert (program.values, program.left_out) == (0, 0)
    u, phi, rr, theta = sb.functions_of_time("u phi rr theta")
    rates = {each: sb.diff(each, sb.t) for each in (phi, rr, theta)}
    assert (found["VS"], found["camber"], found["VR"]) == (u, phi, rr * rates[theta])
    across = (
        -rr * sb.cos(phi) * rates[phi] - sb.sin(phi) * rates[rr]
    )  # along the road, of the point (0, 0, rr)
    assert sb.simplify(found["VN"] - across) == 0


def test_matrices_in_brackets_their_products_and_powers_are_code() -> None:
    program, values = made(
        "n := 2: K := Matrix(n,n): K[1,2] := k: z := Vector(n): A := <<a,b>|<c,d>>: v := <p,q>: "
        "w := v^%T . A . v: u := v . v: B := <A|v>: C := <A,v^%T>: D2 := A^2: E := 1/A: F := array(1..2,[p,q]): "
        "G := array(1..2,1..2,[[1,2],[3,4]]): y := A . v:"
    )
    assert (program.values, program.left_out) == (0, 0)
    a, b, c, d, p, q = sb.symbols("a b c d p q")
    assert values["A"] == sb.Matrix([[a, c], [b, d]])
    assert values["w"] == a * p**2 + (b + c) * p * q + d * q**2
    assert values["u"] == p**2 + q**2
    assert values["B"].tolist() == [[a, c, p], [b, d, q]]
    assert values["C"].tolist() == [[a, c], [b, d], [p, q]]
    assert values["D2"] == values["A"] @ values["A"]
    assert "K = sb.zeros(n, n)" in program.text
    assert "G = sb.Matrix([[1, 2], [3, 4]])" in program.text


def test_a_name_beside_its_entries_is_declared() -> None:
    program, values = made("s := solve(x[1]+x-2,x): u := x[2] + y:")
    assert (program.values, program.left_out) == (0, 0)
    assert str(values["u"]) == "x[2] + y"


def test_each_procedure_of_a_name_has_its_place() -> None:
    program, values = made(
        "p := proc(f) f + 2 end: p := proc(x) local i; x^3 end: p := x -> if x > 0 then x else -x end if: a := p(-3): "
        "p := proc(x) x + 1 end: b := p(2):"
    )
    assert (program.values, program.left_out) == (0, 0)
    assert (values["a"], values["b"]) == (3, 3)
    assert "return f + 2" in program.text
    assert "return x**3" in program.text
