"""Reports: a model, its equations and a motion as one document."""

from symbody.document.report import report

__all__ = ["report"]
