"""The page of all models is written by a script, and each has a picture (`test_models.py` compares what they show)."""

from __future__ import annotations

from scripts.gallery import PAGE, PICTURES, page
from symbody.models import MODELS


def test_the_page_is_up_to_date() -> None:
    """`python -m scripts.gallery` writes it."""
    assert PAGE.read_text(encoding="utf-8") == page()


def test_each_model_has_a_picture() -> None:
    assert {path.name for path in PICTURES.iterdir()} == {f"{make.__name__}.svg" for make in MODELS}
