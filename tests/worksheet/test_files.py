"""Files: save and read, fopen and fprintf, FileTools; nothing is written outside the output folder."""

from pathlib import Path

import pytest

from symbody.worksheet.interpreter.interpret import Interpreter
from tests.worksheet.printed_by import failures, printed


def test_saved_values_are_read_back(tmp_path: Path) -> None:
    text = (
        "a := [x^2, diff(q(t),t), 1/3]: T := table([k=2*x, 3=b]): M := Matrix([[a1,2],[3,4]]): f := x -> x^2: "
        's := {u = "text"}: v := <1,2>: save a, T, M, f, s, v, "values.mpl";'
    )
    printed(text, tmp_path)
    lines = printed(
        'read "values.mpl": a; T[k], T[3]; M; f(3); s; v;',
        tmp_path,
    )
    assert lines == [
        "[x^2, diff(q(t),t), 1/3]",
        "2*x, b",
        "Matrix([[a1, 2], [3, 4]])",
        "9",
        '{u = "text"}',
        "Vector[column]([[1], [2]])",
    ]


def test_saved_objects_are_objects_again(tmp_path: Path) -> None:
    printed('P := make_POINT(translate(q(t),0,0),1,2,3): save(P, "P.mpl"):', tmp_path)
    assert (tmp_path / "P.mpl").read_text().startswith("P := table([")
    assert printed('read "P.mpl": comp_XYZ(velocity(P)); comp_X(P,ground);', tmp_path) == [
        "diff(q(t),t), 0, 0",
        "q(t)+1",
    ]


def test_saved_forces_act_on_the_saved_bodies_of_a_table(tmp_path: Path) -> None:
    bodies = "w[1] := make_BODY(translate(x(t),0,0), m): w[2] := make_BODY(translate(x(t),b,0), m): "
    force = "F := make_FORCE(make_VECTOR(ground,X,0,0), origin(ground), w[1]): "
    printed(bodies + force + 'save w, F, "w.mpl":', tmp_path)
    text = 'read "w.mpl": comp_X(newton_equations({w[1], w[2], F}));'
    assert printed(text, tmp_path)[-1] == "2*m*diff(x(t),`$`(t,2))-X"
    skipped = printed('read "w.mpl": comp_X(newton_equations({w[2], F}));', tmp_path)
    assert skipped[0] == "<F> FORCE is not valid: it must be applied to a BODY"


def test_values_are_saved_with_what_was_assigned_since(tmp_path: Path) -> None:
    printed('a := 2*b: b := 3: save a, "a.m";', tmp_path)
    assert (tmp_path / "a.m").read_text() == "a := 6;\n"


def test_all_names_are_saved_if_none_is_given(tmp_path: Path) -> None:
    text = "with(MBSymba_r6): a := 2: X(t) := V*t: nothing := NULL: `diff/w` := proc(t) wd(t) end: "
    printed(text + 'linear_modeling({y(t)}): save "all.m": save X, unknown, "x.m";', tmp_path)
    assert printed('read "all.m": a, X(t), diff(w(t),t), [nothing]; type(ground,frame);', tmp_path) == [
        "2, V*t, wd(t), []",
        "true",
    ]
    assert "small_vars" not in (tmp_path / "all.m").read_text()
    assert (tmp_path / "x.m").read_text() == "X(t) := V*t;\n"


def test_what_can_not_be_saved(tmp_path: Path) -> None:
    assert failures('save(x + 1, "x.m"):', tmp_path) == [
        "save: x+1 is not a name; expected names, then a file"
    ]
    interpreter = Interpreter()
    printed('save unknown, "x.m":', tmp_path, interpreter)
    assert interpreter.session.notices == ["save: unknown has no value; the file is written without it"]


def test_read_looks_beside_the_sheet_second(tmp_path: Path) -> None:
    sheet, output = tmp_path / "sheet", tmp_path / "out"
    sheet.mkdir()
    output.mkdir()
    (sheet / "data.mpl").write_text("k := 1:")
    interpreter = Interpreter()
    interpreter.session.source = sheet
    assert printed('read "data.mpl": k;', output, interpreter) == ["1"]
    (output / "data.mpl").write_text("k := 2:")
    assert printed('read "C:/work/data.mpl": k;', output, interpreter) == ["2"]


def test_a_file_that_is_not_there_is_told(tmp_path: Path) -> None:
    (message,) = failures('read "nothing.mpl";', tmp_path)
    assert (
        message == "unable to read 'nothing.mpl': it is neither in the output folder nor beside the worksheet"
    )


def test_formatted_lines(tmp_path: Path) -> None:
    printed(
        'f := fopen("C:/data/out.txt",WRITE): fprintf(f,"%d %s\\n",3,"a"): writeline(f,"end"): fclose(f):',
        tmp_path,
    )
    assert (tmp_path / "data" / "out.txt").read_text() == "3 a\nend\n"


def test_folders(tmp_path: Path) -> None:
    text = (
        'FileTools[Exists]("d"); FileTools[MakeDirectory]("d"): FileTools[Exists]("d"); '
        'FileTools[RemoveDirectory]("d",recurse=true): FileTools:-Exists("d");'
    )
    assert printed(text, tmp_path) == ["false", "true", "false"]


@pytest.mark.parametrize(
    "statement",
    [
        'save a, "../a.mpl"',
        'f := fopen("../../x.txt",WRITE)',
        'FileTools[MakeDirectory]("../d")',
        'FileTools[RemoveDirectory]("..")',
        'fprintf("x/../../y","a")',
        'read "../secret.mpl"',
        'FileTools[Remove]("../a")',
    ],
)
def test_nothing_outside_the_output_folder_is_touched(statement: str, tmp_path: Path) -> None:
    inner = tmp_path / "out"
    inner.mkdir()
    (tmp_path / "secret.mpl").write_text("a := 1;")
    (message,) = failures(f"a := 5: {statement};", inner)
    assert "is not inside the output folder; expected a plain name" in message
    assert sorted(path.name for path in tmp_path.iterdir()) == ["out", "secret.mpl"]


def test_a_link_does_not_lead_out(tmp_path: Path) -> None:
    inner = tmp_path / "out"
    inner.mkdir()
    (inner / "link").symlink_to(tmp_path)
    (message,) = failures('a := 5: save a, "link/a.mpl";', inner)
    assert "is not inside the output folder" in message


@pytest.mark.parametrize("statement", ['system("ls")', 'ssystem("ls")'])
def test_commands_of_the_system_are_refused(statement: str) -> None:
    assert failures(f"{statement};") == ["a worksheet can't run commands of the system"]


def test_long_sums_are_saved_and_read(tmp_path: Path) -> None:
    text = 'z := add(a||i*sin(b||i), i=1..3000): save z, "z.mpl": y := z: read "z.mpl": y - z;'
    assert printed(text, tmp_path) == ["0"]


def test_an_error_in_a_file_that_is_read_shows_the_line_of_that_file(tmp_path: Path) -> None:
    (tmp_path / "data.mpl").write_text("a := 1;\n\nb := [1, 2][a + 2];\n")
    (message,) = failures('x := 1: read "data.mpl";', tmp_path)
    assert message == (
        'in "data.mpl", line 3, column 6: the index 3 is out of range; expected one from 1 to 2\n'
        "  b := [1, 2][a + 2];\n       ^"
    )


def test_a_mistake_in_a_file_that_is_read_shows_the_line_of_that_file(tmp_path: Path) -> None:
    (tmp_path / "data.mpl").write_text("a := 1;\nb := 2 +* 3;\n")
    (message,) = failures('read "data.mpl";', tmp_path)
    assert message.startswith('in "data.mpl", line 2, column 9: found ')


def test_an_error_in_a_procedure_tells_where_this_is_written(tmp_path: Path) -> None:
    """One of a file that was read, called by the sheet; and one of the sheet, called by a file."""
    (tmp_path / "lib.mpl").write_text("# a library\nf := proc(i)\n  [1, 2][i]\nend proc:\n")
    (tmp_path / "call.mpl").write_text("g(3);\n")
    found = failures('read "lib.mpl": f(3); g := i ->\n[1, 2][i]: read "call.mpl";', tmp_path)
    assert found[0].startswith('(in f) in "lib.mpl", line 3, column 3: the index 3 is out of range')
    assert found[1].startswith('in "call.mpl", line 1, column 1: (in g) the index 3 is out of range')
    assert "(line 2 of the worksheet)" in found[1]


def test_the_description_of_a_procedure_is_saved(tmp_path: Path) -> None:
    printed('p := proc(a) local b; description "twice", "a"; b := 2*a; b end: save p, "p.mpl";', tmp_path)
    text = 'p := proc (a) local b; description "twice", "a"; b := 2*a; b end proc;\n'
    assert (tmp_path / "p.mpl").read_text() == text
    assert printed('read "p.mpl": p(3);', tmp_path) == ["6"]


def test_saved_procedures_keep_the_backquotes_of_their_names(tmp_path: Path) -> None:
    printed(
        "f := proc(a) local `my x`; `my x` := `if`(a > 2, a, -a); `union`({`my x`}, {1}) end: "
        'r := x -> round(x): save f, r, "f.txt":',
        tmp_path,
    )
    assert printed('read "f.txt": f(1), f(3), r(z), r(2.5);', tmp_path) == ["{-1, 1}, {1, 3}, round(z), 3"]
