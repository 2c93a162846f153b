//! Straight-line code: its instructions, and its evaluation on `NumPy` arrays.

use pyo3::buffer::PyBuffer;
use pyo3::prelude::*;
use pyo3::types::{PyList, PyTuple};
use symbody_core::{Column, Cost, Error, Evaluator, Instruction, Operand, Staged};

use crate::convert::operands;
use crate::deficiency::note;
use crate::session::{long_with_forms, raise};

/// Additions, multiplications, divisions, functions.
type Counts = (u64, u64, u64, u64);

/// Expressions lowered to straight-line code: instructions in static single assignment, sorted by stage.
///
/// A place is a number: constants come first, then inputs, then the results of the instructions.
#[pyclass(frozen, module = "symbody.symbolic._core")]
pub struct Tape {
    evaluator: Evaluator,
    staged: Staged,
}

#[pymethods]
impl Tape {
    #[new]
    #[pyo3(signature = (inputs, outputs, stages = None, where_ = "lambdify"))]
    fn new(
        py: Python<'_>,
        inputs: &Bound<'_, PyAny>,
        outputs: &Bound<'_, PyAny>,
        stages: Option<Vec<u8>>,
        where_: &str,
    ) -> PyResult<Self> {
        let inputs = operands(inputs, &format!("{where_}, arguments"))?;
        let outputs = operands(outputs, &format!("{where_}, expressions"))?;
        let tape = long_with_forms(py, |graph| graph.tape(&inputs, &outputs))?;
        let staged = raise(py, tape.staged(&stages.unwrap_or_default()))?;
        Ok(Self { evaluator: Evaluator::new(&staged.tape), staged })
    }

    /// The operations: additions, multiplications, divisions, functions.
    #[getter]
    fn operations(&self) -> Counts {
        counts(self.staged.tape.operations())
    }

    /// The operations of each stage.
    #[getter]
    fn stage_operations(&self) -> Vec<Counts> {
        self.staged.operations().into_iter().map(counts).collect()
    }

    /// The number of outputs.
    #[getter]
    fn outputs(&self) -> usize {
        self.staged.tape.outputs.len()
    }

    /// The number of inputs.
    #[getter]
    fn inputs(&self) -> usize {
        self.staged.tape.inputs.len()
    }

    /// The numbers in the code.
    #[getter]
    fn constants(&self) -> Vec<f64> {
        self.staged.tape.constants.clone()
    }

    /// The instructions: a name and the places, or the numbers in lists, that it works on.
    #[getter]
    fn instructions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let rows = self.staged.tape.instructions.iter();
        let rows: PyResult<Vec<_>> = rows.map(|&instruction| self.row(py, instruction)).collect();
        PyList::new(py, rows?)
    }

    /// The stage of each instruction.
    #[getter]
    fn instruction_stages(&self) -> Vec<u32> {
        self.staged.stages.iter().map(|&stage| u32::from(stage)).collect()
    }

    /// The matrices of linear systems: size, and the places of the entries row by row.
    #[getter]
    fn factorizations(&self) -> Vec<(usize, Vec<u32>)> {
        let all = self.staged.tape.factorizations.iter();
        all.map(|matrix| (matrix.size, self.places(&matrix.entries))).collect()
    }

    /// The linear systems: the place of the factorisation, and those of the right side.
    #[getter]
    fn solves(&self) -> Vec<(u32, Vec<u32>)> {
        let all = self.staged.tape.solutions.iter();
        all.map(|system| (self.place(system.factorization), self.places(&system.right))).collect()
    }

    /// The place of each output.
    #[getter]
    fn results(&self) -> Vec<u32> {
        self.places(&self.staged.tape.outputs)
    }

    /// The outputs at one point.
    fn evaluate(&self, py: Python<'_>, inputs: Vec<f64>) -> PyResult<Vec<f64>> {
        let (outputs, found) = raise(py, self.evaluator.evaluate_noting(&inputs))?;
        note(found);
        Ok(outputs)
    }

    /// Write the outputs at many points into `out`, output by output; an input with one value has it at all points.
    fn evaluate_columns(
        &self,
        py: Python<'_>,
        inputs: Vec<PyBuffer<f64>>,
        points: usize,
        out: &Bound<'_, PyAny>,
    ) -> PyResult<()> {
        // Check before allocating the results, which may not fit into memory.
        let out = PyBuffer::<f64>::get(out)?;
        if self.outputs().checked_mul(points) != Some(out.item_count()) {
            let (left, right) = ((self.outputs(), points), (out.item_count(), 1));
            return raise(py, Err(Error::Shape { operation: "evaluation", left, right }));
        }
        let values: Vec<Vec<f64>> = inputs.iter().map(|buffer| buffer.to_vec(py)).collect::<PyResult<_>>()?;
        let columns: Vec<Column> = values
            .iter()
            .map(|value| match value[..] {
                [single] => Column::Scalar(single),
                _ => Column::Array(value),
            })
            .collect();
        let result = py.detach(|| self.evaluator.evaluate_columns_noting(&columns, points));
        let (result, found) = raise(py, result)?;
        note(found);
        out.copy_from_slice(py, &result)
    }
}

impl Tape {
    fn place(&self, operand: Operand) -> u32 {
        let (first_input, first_value) = self.staged.tape.first_places();
        match operand {
            Operand::Constant(constant) => constant,
            Operand::Input(input) => first_input + input,
            Operand::Value(value) => first_value + value,
        }
    }

    fn places(&self, operands: &[Operand]) -> Vec<u32> {
        operands.iter().map(|&operand| self.place(operand)).collect()
    }

    fn row<'py>(&self, py: Python<'py>, instruction: Instruction) -> PyResult<Bound<'py, PyTuple>> {
        let name = match instruction {
            Instruction::Add(..) => "add",
            Instruction::Sub(..) => "sub",
            Instruction::Mul(..) => "mul",
            Instruction::Div(..) => "div",
            Instruction::Neg(_) => "neg",
            Instruction::Sqrt(_) => "sqrt",
            Instruction::Unary(function, _) | Instruction::Binary(function, ..) => function.name(),
            Instruction::Select { .. } => "select",
            Instruction::Factor(number) => return ("factor", number).into_pyobject(py),
            Instruction::Solve(number) => return ("solve", number).into_pyobject(py),
            Instruction::Component(solution, index) => {
                return ("component", self.place(solution), index).into_pyobject(py);
            }
        };
        let places: Vec<u32> = instruction.operands().map(|operand| self.place(operand)).collect();
        match places[..] {
            [a] => (name, a).into_pyobject(py),
            [a, b] => (name, a, b).into_pyobject(py),
            [a, b, c] => (name, a, b, c).into_pyobject(py),
            _ => (name,).into_pyobject(py),
        }
    }
}

const fn counts(cost: Cost) -> Counts {
    (cost.additions, cost.multiplications, cost.divisions, cost.functions)
}

pub fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Tape>()
}
