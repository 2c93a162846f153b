"""The page of all models is written by a script, and has a picture of each."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Callable

import pytest

from scripts.gallery import PAGE, PICTURES, page, picture
from symbody.models import MODELS, ClassicSystem


def test_the_page_is_up_to_date() -> None:
    """`python -m scripts.gallery` writes it."""
    assert PAGE.read_text(encoding="utf-8") == page()


def test_each_model_has_a_picture() -> None:
    assert {path.name for path in PICTURES.iterdir()} == {f"{make.__name__}.svg" for make in MODELS}


@pytest.mark.parametrize("make", MODELS, ids=lambda make: make.__name__)
def test_pictures_show_the_bodies(make: Callable[[], ClassicSystem]) -> None:
    drawn = ET.fromstring(picture(make))
    stored = ET.fromstring((PICTURES / f"{make.__name__}.svg").read_text(encoding="utf-8"))
    labels = [
        [text.text for text in each.iter("{http://www.w3.org/2000/svg}text")] for each in (drawn, stored)
    ]
    assert labels[0] == labels[1]
    assert {body.name for body in make().system.bodies} <= {*labels[0]}
