//! Straight-line code and its evaluation on `NumPy` arrays.

use pyo3::buffer::PyBuffer;
use pyo3::prelude::*;
use symbody_core::{Column, Evaluator};

use crate::convert::operands;
use crate::session::{raise, with_forms};

/// Expressions lowered to straight-line code, ready for evaluation.
#[pyclass(frozen, module = "symbody.symbolic._core")]
pub struct Tape {
    evaluator: Evaluator,
    /// Additions, multiplications, divisions, functions.
    #[pyo3(get)]
    operations: (u64, u64, u64, u64),
    /// The number of outputs.
    #[pyo3(get)]
    outputs: usize,
}

#[pymethods]
impl Tape {
    #[new]
    fn new(py: Python<'_>, inputs: &Bound<'_, PyAny>, outputs: &Bound<'_, PyAny>) -> PyResult<Self> {
        let inputs = operands(inputs, "lambdify, arguments")?;
        let outputs = operands(outputs, "lambdify, expressions")?;
        let tape = raise(py, with_forms(|graph| graph.tape(&inputs, &outputs)))?;
        let count = tape.operations();
        Ok(Self {
            evaluator: Evaluator::new(&tape),
            operations: (count.additions, count.multiplications, count.divisions, count.functions),
            outputs: outputs.len(),
        })
    }

    /// The outputs at one point.
    fn evaluate(&self, py: Python<'_>, inputs: Vec<f64>) -> PyResult<Vec<f64>> {
        raise(py, self.evaluator.evaluate(&inputs))
    }

    /// The outputs at many points, output by output, into `out`; an input of one value serves all points.
    fn evaluate_columns(
        &self,
        py: Python<'_>,
        inputs: Vec<PyBuffer<f64>>,
        points: usize,
        out: &Bound<'_, PyAny>,
    ) -> PyResult<()> {
        let values: Vec<Vec<f64>> = inputs.iter().map(|buffer| buffer.to_vec(py)).collect::<PyResult<_>>()?;
        let columns: Vec<Column> = values
            .iter()
            .map(|value| match value[..] {
                [single] => Column::Scalar(single),
                _ => Column::Array(value),
            })
            .collect();
        let result = py.detach(|| self.evaluator.evaluate_columns(&columns, points));
        let result = raise(py, result)?;
        PyBuffer::<f64>::get(out)?.copy_from_slice(py, &result)
    }
}

pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Tape>()
}
