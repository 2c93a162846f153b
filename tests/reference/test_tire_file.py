"""Tyre property files: the forces of mfeval by files of its sample tyres, in several units; further terms."""

from __future__ import annotations

import json
import math
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from symbody import ModelNotice, lambdify, magic_formula, symbols, tire_file
from symbody.errors import LoadError

SETS: dict[str, Any] = json.loads((Path(__file__).parent / "magic_formula.json").read_text(encoding="utf-8"))
FITTYP = {"5.2": 6, "6.1": 61}

UNITS: dict[str, tuple[str, dict[str, float]]] = {
    "SI": ("LENGTH = 'meter'\nFORCE = 'newton'\n", {}),
    "mm, kN": (
        "LENGTH ='mm' $ a comment\r\nFORCE= 'kN'",
        {"UNLOADED_RADIUS": 1e3, "FNOMIN": 1e-3, "NOMPRES": 1e-9},
    ),
    "lb, foot": (
        "length = 'foot'\nFORCE = 'pound_force'\nANGLE = radians",
        {
            "UNLOADED_RADIUS": 1 / 0.3048,
            "FNOMIN": 1 / 4.4482216152605,
            "NOMPRES": 0.3048**2 / 4.4482216152605,
        },
    ),
}


def text_of(given: dict[str, Any], units: str) -> str:
    """Return a tyre property file of a published set of coefficients."""
    named, per_unit = UNITS[units]
    entries = [f"{name} = {value * per_unit.get(name, 1)!r}" for name, value in given["coefficients"].items()]
    return "\n".join(
        [
            *("[MDI_HEADER]", "FILE_TYPE = 'tir'", "! a comment", "[UNITS]", named, "[MODEL]"),
            *(f"FITTYP = {FITTYP[given['version']]} $version", "TYRESIDE = 'LEFT'", "[INERTIA]", "MASS ="),
            *("[SHAPE]", "{radial width}", " 1.0 0.0", "[LATERAL_COEFFICIENTS]", *entries),
        ]
    )


@pytest.mark.parametrize("units", UNITS)
@pytest.mark.parametrize("name", ["set 5.2", "set 6.1"])
def test_forces_by_files_are_those_of_mfeval(name: str, units: str, tmp_path: Path) -> None:
    given = SETS[name]
    path = tmp_path / "tyre.tir"
    path.write_text(text_of(given, units), encoding="latin-1")
    file = tire_file(path)
    assert (file.version, file.side) == (given["version"], "left")
    at = dict(zip(given["columns"], np.array(given["rows"]).T, strict=True))
    N, kappa, slip, camber, pressure = symbols("N kappa slip camber pressure")
    law = file.law(pressure=pressure) if "pressure" in at else file.law()
    f = lambdify([N, kappa, slip, camber, pressure], list(law(N, kappa, slip, camber))[:2])
    pressures = at.get("pressure", np.ones_like(at["load"]))
    Fx, Fy = f(at["load"], at["kappa"], np.tan(at["alpha"]), at["camber"], pressures)
    np.testing.assert_allclose(Fx, at["Fx"], rtol=3e-9)
    np.testing.assert_allclose(Fy, at["Fy"], rtol=1e-9)


def test_the_pressure_of_a_file_is_that_of_its_law(tmp_path: Path) -> None:
    """Friction by 1 + PPX3 dp + PPX4 dp^2 with dp = INFLPRES/NOMPRES - 1 [Besselink et al. 2010]."""
    entries = "FNOMIN = 4\nUNLOADED_RADIUS = 0.3\nPCX1 = 1\nPDX1 = 1.2\nPKX1 = 1e6\nPPX3 = 0.4\nPPX4 = -0.5\n"
    pressures = "[OPERATING_CONDITIONS]\nINFLPRES = 165\nNOMPRES = 220\n"
    path = tmp_path / "soft.tir"
    path.write_text(f"[UNITS]\nFORCE = 'kN'\n[MODEL]\nFITTYP = 61\n{pressures}{entries}", encoding="utf-8")
    file = tire_file(path)
    dp = 165 / 220 - 1
    peak = 1.2 * 4000 * (1 + 0.4 * dp - 0.5 * dp**2)
    assert file.law()(4000, 1).longitudinal.evaluate({}) == pytest.approx(peak, rel=1e-5)
    nominal = file.law(pressure=file["NOMPRES"])(4000, 1)
    assert nominal.longitudinal.evaluate({}) == pytest.approx(1.2 * 4000, rel=1e-5)


def test_friction_decreases_with_the_speed_of_sliding() -> None:
    """LMUX and LMUY by 1 + LMUV Vs/V0 (4.E7), with Vs = |Vx| sqrt(kappa^2 + tan(alpha)^2)."""
    p = SETS["set 6.1"]["coefficients"] | {"LMUV": 0.2, "LONGVL": 16.6}
    kappa, slip, speed = -0.1, 0.12, 30.0
    factor = 1 / (1 + 0.2 * speed * math.hypot(kappa, slip) / 16.6)
    slower = magic_formula(p | {"LMUV": 0, "LMUX": factor, "LMUY": factor}, version="6.1")
    found = magic_formula(p, version="6.1")(5000, kappa, slip, 0.05, speed=speed)
    expected = slower(5000, kappa, slip, 0.05)
    for one, other in zip(found, expected, strict=True):
        assert one.evaluate({}) == pytest.approx(other.evaluate({}), rel=1e-12)
    assert abs(found.lateral.evaluate({})) < 0.95 * abs(
        slower(5000, kappa, slip, 0.05).lateral.evaluate({}) / factor
    )


def test_terms_of_set_6_2() -> None:
    """``Mx += R0 LMX (Fy (QSX13 + QSX14 |gamma|) - N QSX12 gamma |gamma|)``, as in mfeval; QBZ6 scales the trail."""
    p, gamma = SETS["set 6.1"]["coefficients"], -0.07
    plain = magic_formula(p, version="6.1")(5000, 0.02, 0.05, gamma)
    more = magic_formula(p | {"QSX12": 0.3, "QSX13": 0.2, "QSX14": -0.4}, version="6.1")(
        5000, 0.02, 0.05, gamma
    )
    added = p["UNLOADED_RADIUS"] * (plain.lateral.evaluate({}) * (0.2 - 0.4 * 0.07) + 5000 * 0.3 * 0.07**2)
    assert (more.overturning - plain.overturning).evaluate({}) == pytest.approx(added, rel=1e-9)
    by_camber = 1 + p["QBZ4"] * gamma + p["QBZ5"] * abs(gamma)
    wider = {name: p[name] * (by_camber + 5 * gamma**2) / by_camber for name in ("QBZ1", "QBZ2", "QBZ3")}
    one, other = (magic_formula(p | change, version="6.1") for change in ({"QBZ6": 5}, wider))
    aligning = [law(5000, 0.02, 0.05, gamma).aligning.evaluate({}) for law in (one, other)]
    assert aligning[0] == pytest.approx(aligning[1], rel=1e-12)
    assert aligning[0] != pytest.approx(plain.aligning.evaluate({}), rel=1e-3)


START = "[MODEL]\nFITTYP = 61\nFNOMIN = 4000\nUNLOADED_RADIUS = 0.3\n"


def test_unknown_coefficients_are_told_in_any_section_but_those_of_the_carcass(tmp_path: Path) -> None:
    path = tmp_path / "a.tir"
    path.write_text(f"{START}PXX9 = 3\nPCY12 = 1\n[VERTICAL]\nPFZ1 = 0.7\n", encoding="utf-8")
    with pytest.warns(ModelNotice) as caught:
        assert tire_file(path)["PFZ1"] == 0.7
    assert [str(each.message) for each in caught] == [
        (
            "tire_file a.tir: PXX9 (line 5), PCY12 (line 6) mean nothing to the law and are left out of it; expected "
            "names such as PCY1"
        )
    ]


def test_a_unit_of_pressure_stands_for_force_and_length(tmp_path: Path) -> None:
    path = tmp_path / "a.tir"
    path.write_text(f"[UNITS]\nLENGTH = 'mm'\nPRESSURE = 'bar'\n{START}NOMPRES = 2.2\n", encoding="utf-8")
    assert tire_file(path)["NOMPRES"] == pytest.approx(2.2e5, rel=1e-12)
    path.write_text(f"[UNITS]\nLENGTH = 'mm'\n{START}NOMPRES = 0.22\n", encoding="utf-8")
    assert tire_file(path)["NOMPRES"] == pytest.approx(2.2e5, rel=1e-12)


@pytest.mark.parametrize("version", ["5.2", "6.1"])
def test_a_tyre_on_the_other_side_is_the_image_in_the_plane_of_the_wheel(
    version: str, tmp_path: Path
) -> None:
    """Conicity and ply steer pull a car whose four tyres come from one side, and cancel if two of them are mirrored."""
    path = tmp_path / "a.tir"
    path.write_text(text_of(SETS[f"set {version}"], "SI"), encoding="latin-1")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelNotice)
        left, right = (tire_file(path).law(side=side) for side in ("left", "right"))
    one, other = left(4000, 0.02, 0.05, 0.03, speed=16), right(4000, 0.02, -0.05, -0.03, speed=16)
    values = [[each.evaluate({}) for each in force] for force in (one, other)]
    assert values[1] == pytest.approx([v * s for v, s in zip(values[0], (1, -1, -1, 1, -1), strict=True)])
    straight = [law(4000, speed=16).lateral.evaluate({}) for law in (left, right)]
    assert straight[0] == pytest.approx(-straight[1])
    assert abs(straight[0]) > 1


def test_a_tyre_without_longitudinal_coefficients_has_an_aligning_moment() -> None:
    """Lateral tests alone: the moment is that of a tyre with longitudinal coefficients in pure lateral slip."""
    lateral = {"FNOMIN": 4000, "UNLOADED_RADIUS": 0.313, "PCY1": 1.3, "PDY1": 0.99, "PKY1": -15, "PKY2": 1.7}
    trail = {"QBZ1": 8, "QCZ1": 1.1, "QDZ1": 0.1}
    along = {"PCX1": 1.6, "PDX1": 1.1, "PKX1": 22}
    expected = magic_formula(lateral | trail | along)(4000, 0, 0.05).aligning.evaluate({})
    for without in ({}, {"PCX1": 0}, {"PCX1": 0, "PDX1": 1.1, "PKX1": 22}):
        law = magic_formula(lateral | trail | without)
        for kappa in (0, 0.05, symbols("kappa")):
            found = law(4000, kappa, 0.05).aligning
            assert found.evaluate({symbols("kappa"): 0.02}) == pytest.approx(expected, rel=1e-12)
    for part, missing in ((along, "PCX1"), (lateral, "PCY1")):
        some = {**lateral, **part}
        with pytest.raises(LoadError, match=f"magic_formula: {missing} missing; expected the nominal load"):
            magic_formula({name: value for name, value in some.items() if name != missing})
