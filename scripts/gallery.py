"""Write docs/models.md, a page of all models, and their pictures in docs/pictures/models.

The table of the models is `symbody.models.MODELS`. Run from the root of the repository: ``python -m scripts.gallery``.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable
from pathlib import Path

from symbody import Equations, cost, forward_dynamics, newton_euler, number, simulate
from symbody.models import MODELS, ClassicSystem
from symbody.view.sketch import sketch
from symbody.view.svg import sketch_svg

from .gallery_drawings import drawing_of

DOCS = Path(__file__).parents[1] / "docs"
PAGE = DOCS / "models.md"
PICTURES = DOCS / "pictures" / "models"

Make = Callable[[], ClassicSystem]

_HEAD = """\
# Models

`symbody.models` has classic systems as functions. Each returns a `ClassicSystem`, which you can simulate at once:

```python
import symbody as sb
from symbody import models

model = models.furuta_pendulum()
equations = sb.newton_euler(model.system)
motion = sb.simulate(
    equations, model.parameters, model.initial, t=(0, 2), inputs=model.inputs, guess=model.guess
)
print(motion.energy_drift < 1e-6)  # True
```

* `model.system` is the system in symbols, as you would write it yourself. `model["theta2"]` finds a coordinate, an
  input or a parameter by its name, and `model.names` has all of them.
* `model.parameters` are the numbers of the source, or typical ones, in SI units and rad. Change some of them by
  `model.parameters | {model["g"]: 1.62}`.
* `model.initial` is the start of a typical motion, and `model.guess` tells where closed loops are there.
* `model.inputs` are values of the inputs, such as the torques of motors. Give expressions of time and state instead,
  such as the law of a controller.
* `model.source` is the publication.

Tests compare each model with equations or numbers of its source, or with a closed form (`tests/models`). To begin a
model of your own, copy the function: it is short. [Extending](extending.md#a-model) shows how to add one.

This page is written by `python -m scripts.gallery`.

Below, `size` counts the operations that one evaluation takes: of the residuals, then of the accelerations. The times of
derivations and motions are measured in [docs/benchmarks/models.md](benchmarks/models.md).

```python
def size(model):
    derived = sb.newton_euler(model.system)
    solved = sb.forward_dynamics(derived).accelerations
    return sb.cost(derived.residuals).total, sb.cost(solved).total
```

| model | coordinates | constraints | residuals | accelerations |
|---|---:|---:|---:|---:|
"""


def size(model: ClassicSystem) -> tuple[int, int]:
    """Return the operations of the residuals and of the accelerations."""
    equations = newton_euler(model.system)
    return cost(equations.residuals).total, cost(forward_dynamics(equations).accelerations).total


def page() -> str:
    """Return the text of the page."""
    models = [(make, model, size(model)) for make in MODELS for model in [make()]]
    return _HEAD + "".join(_row(*each) for each in models) + "".join(_section(*each) for each in models)


def _row(make: Make, model: ClassicSystem, operations: tuple[int, int]) -> str:
    system, (residuals, accelerations) = model.system, operations
    name = f"[`{make.__name__}`](#{make.__name__})"
    sizes = len(system.coordinates or system.speeds), len(system.constraints), residuals, accelerations
    return f"| {name} | " + " | ".join(map(str, sizes)) + " |\n"


def _section(make: Make, model: ClassicSystem, operations: tuple[int, int]) -> str:
    """Return what the docstring of a function says, one line of code that uses it, its source and its picture."""
    described = (inspect.getdoc(make) or "").partition("\n\n>>>")[0].removeprefix("Return ")
    text = described[0].upper() + described[1:]
    signature = inspect.signature(make)
    call = f"{make.__name__}({', '.join(f'{p.name}={p.default}' for p in signature.parameters.values())})"
    return (
        f"\n## {make.__name__}\n\n{text}\n\n"
        f"```python\nprint(size(models.{call}))  # {operations}\n```\n\n"
        f"Source: {model.source}.\n\n"
        f"![{model.system.name}](pictures/models/{make.__name__}.svg)\n"
    )


def picture(name: str, model: ClassicSystem, equations: Equations) -> str:
    """Return a model at the first instant of its motion, as SVG."""
    motion = simulate(
        equations,
        model.parameters,
        model.initial,
        (0, _duration(model)),
        inputs=model.inputs,
        guess=model.guess,
    )
    return sketch_svg(sketch(motion, options=drawing_of(name, model)))


def _duration(model: ClassicSystem) -> float:
    """Return how long a model moves for its picture, in s: less for vehicles, whose way would make them small."""
    speed = model.initial.get(model.names.get("x'", number(0)), 0.0)
    return 0.5 if speed < 10 else 0.02


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
    PICTURES.mkdir(parents=True, exist_ok=True)
    for each in MODELS:
        made = each()
        drawn = picture(each.__name__, made, newton_euler(made.system))
        (PICTURES / f"{each.__name__}.svg").write_text(drawn, encoding="utf-8")
    print(f"{PAGE}: {len(MODELS)} models")
