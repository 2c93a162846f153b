"""JAX: functions that compile, differentiate and map over batches, and a self-check of the compiled ones."""

from __future__ import annotations

from symbody.codegen.languages.python import Library, files_with, python_language
from symbody.codegen.languages.target import Target
from symbody.codegen.runtime.snippets import SNIPPETS

__all__ = ["JAX"]

LANGUAGE = python_language("jnp")

_ARRAY = '''
# Equations of motion need all the digits of a double.
jax.config.update("jax_enable_x64", True)


def array(entries, shape):
    """Return the entries as one array of the shape."""
    return jnp.stack([jnp.asarray(entry, dtype=float) for entry in entries]).reshape(shape)
'''

_SQUARE = '''
def square(entries, n):
    """Return the entries of a matrix, row by row, as a matrix."""
    return array(entries, (n, n))
'''

LIBRARY = Library(
    LANGUAGE,
    "Functions of the model. Arguments are arrays, results are arrays of the shapes given here and numbers, for one "
    "state; jax.jit compiles them, jax.vmap maps them over states, jax.jacfwd and jax.grad differentiate them.",
    ("import jax", "import jax.numpy as jnp"),
    _ARRAY,
    _SQUARE + "\n" + SNIPPETS["jax"],
    called="jax.jit(model.{function})({arguments})",
)


JAX = Target(
    name="jax",
    title="Python with JAX",
    language=LANGUAGE,
    files=files_with(LIBRARY),
    check=("python {name}_check.py",),
    limit=None,
)
