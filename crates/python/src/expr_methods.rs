//! The methods of `Expr`: Python's protocols, and the properties of a node.

use std::collections::BTreeSet;

use num_bigint::BigInt;
use pyo3::basic::CompareOp;
use pyo3::exceptions::PyAttributeError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyFrozenSet, PyTuple};
use symbody_core::{Assumption, Deficiency, Error, Evaluator, Function, Graph, Id, Number, NumberId, View};

use crate::convert::{keys, mistake, operand, optional, pairs};
use crate::deficiency::report;
use crate::expr::{Expr, leaves};
use crate::namesake::notice_namesakes;
use crate::operators::{ADD, SUBTRACT, binary, no_order, power, rational_hash};
use crate::session::{argument_error, long_with_forms, long_with_graph, raise, with_forms, with_graph};

#[pymethods]
impl Expr {
    fn __add__(slf: &Bound<'_, Self>, other: &Bound<'_, PyAny>) -> PyResult<Py<PyAny>> {
        binary(slf.as_any(), other, ADD)
    }

    fn __radd__(slf: &Bound<'_, Self>, other: &Bound<'_, PyAny>) -> PyResult<Py<PyAny>> {
        binary(other, slf.as_any(), ADD)
    }

    fn __sub__(slf: &Bound<'_, Self>, other: &Bound<'_, PyAny>) -> PyResult<Py<PyAny>> {
        binary(slf.as_any(), other, SUBTRACT)
    }

    fn __rsub__(slf: &Bound<'_, Self>, other: &Bound<'_, PyAny>) -> PyResult<Py<PyAny>> {
        binary(other, slf.as_any(), SUBTRACT)
    }

    fn __mul__(slf: &Bound<'_, Self>, other: &Bound<'_, PyAny>) -> PyResult<Py<PyAny>> {
        binary(slf.as_any(), other, Graph::mul)
    }

    fn __rmul__(slf: &Bound<'_, Self>, other: &Bound<'_, PyAny>) -> PyResult<Py<PyAny>> {
        binary(other, slf.as_any(), Graph::mul)
    }

    fn __truediv__(slf: &Bound<'_, Self>, other: &Bound<'_, PyAny>) -> PyResult<Py<PyAny>> {
        binary(slf.as_any(), other, Graph::div)
    }

    fn __rtruediv__(slf: &Bound<'_, Self>, other: &Bound<'_, PyAny>) -> PyResult<Py<PyAny>> {
        binary(other, slf.as_any(), Graph::div)
    }

    fn __pow__(
        slf: &Bound<'_, Self>,
        other: &Bound<'_, PyAny>,
        modulo: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Py<PyAny>> {
        if modulo.is_some() {
            let message = "pow takes an expression and an exponent, but no modulus";
            return Err(argument_error(slf.py(), message.to_owned()));
        }
        binary(slf.as_any(), other, power)
    }

    fn __rpow__(
        slf: &Bound<'_, Self>,
        other: &Bound<'_, PyAny>,
        _modulo: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Py<PyAny>> {
        binary(other, slf.as_any(), power)
    }

    fn __neg__(&self) -> Self {
        Self(with_graph(|graph| graph.neg(self.0)))
    }

    const fn __pos__(&self) -> Self {
        *self
    }

    fn __abs__(&self, py: Python<'_>) -> PyResult<Self> {
        long_with_graph(py, |graph| graph.apply(Function::Abs, &[self.0])).map(Self)
    }

    fn __richcmp__(slf: &Bound<'_, Self>, other: &Bound<'_, PyAny>, op: CompareOp) -> PyResult<Py<PyAny>> {
        let py = slf.py();
        let equal = match (op, optional(other)) {
            (CompareOp::Eq | CompareOp::Ne, Ok(Some(id))) => {
                long_with_forms(py, |graph| Ok(graph.equal(slf.get().0, id)))?
            }
            (_, Ok(Some(id))) => return Err(no_order(py, slf.get().0, id, op)),
            _ => return Ok(py.NotImplemented()),
        };
        Ok((equal == matches!(op, CompareOp::Eq)).into_pyobject(py)?.to_owned().into_any().unbind())
    }

    /// `NumPy`'s functions of expressions, alone or beside arrays.
    #[pyo3(signature = (ufunc, method, *inputs, **options))]
    fn __array_ufunc__<'py>(
        slf: &Bound<'py, Self>,
        ufunc: &Bound<'py, PyAny>,
        method: &Bound<'py, PyAny>,
        inputs: &Bound<'py, PyTuple>,
        options: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let bridge = slf.py().import("symbody.symbolic.expression.ufunc")?;
        bridge.call_method1("array_ufunc", (ufunc, method, inputs, options))
    }

    /// What isn't found elsewhere: the methods that `NumPy` calls for entries of arrays, or an error with our name
    /// for it.
    fn __getattr__<'py>(slf: &Bound<'py, Self>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let (py, class) = (slf.py(), slf.get_type());
        if let Ok(descriptor) = class.getattr(name) {
            return descriptor.call_method1("__get__", (slf,)); // raise its own error again
        }
        if name.starts_with('_') {
            return Err(PyAttributeError::new_err(format!("'Expr' object has no attribute '{name}'")));
        }
        py.import("symbody.symbolic.expression.ufunc")?.call_method1("attribute", (slf, name))
    }

    /// Agrees with `==`, and for simple numbers with Python's own numbers.
    fn __hash__(&self) -> isize {
        let value = with_forms(|graph| graph.value(self.0));
        value.to_simple_rational().and_then(|number| rational_hash(&number)).unwrap_or_else(|| {
            let [a, b] = value.words();
            isize::from_ne_bytes((a ^ b.rotate_left(32)).to_ne_bytes())
        })
    }

    fn __bool__(&self) -> bool {
        self.0 != Id::ZERO
    }

    fn __float__(&self, py: Python<'_>) -> PyResult<f64> {
        let (value, found) = long_with_forms(py, |graph| constant_value(graph, self.0))?;
        report(py, found, "float")?;
        Ok(value)
    }

    fn __floor__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.rounded(py, "floor")
    }

    fn __ceil__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.rounded(py, "ceil")
    }

    fn __trunc__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.rounded(py, "trunc")
    }

    fn __int__(&self, py: Python<'_>) -> PyResult<BigInt> {
        let number =
            with_forms(|graph| graph.as_number(self.0).filter(|n| n.is_integer()).map(Number::numerator));
        number.ok_or_else(|| {
            argument_error(
                py,
                format!("int: {} is not an integer", with_forms(|graph| graph.to_text(self.0))),
            )
        })
    }

    fn __str__(&self, py: Python<'_>) -> PyResult<String> {
        long_with_forms(py, |graph| Ok(graph.to_text(self.0)))
    }

    /// The value of the expression, given a mapping of its variables to numbers.
    #[pyo3(signature = (values = None))]
    fn evaluate(&self, py: Python<'_>, values: Option<&Bound<'_, PyAny>>) -> PyResult<f64> {
        let (mut inputs, mut numbers) = (Vec::new(), Vec::new());
        if let Some(values) = values {
            let Ok(items) = values.call_method0("items") else {
                let expected = "a mapping of variables to numbers, such as {x: 1.0}";
                return Err(mistake(values, "evaluate", expected));
            };
            for item in items.try_iter()? {
                let (variable, value): (Bound<'_, PyAny>, Bound<'_, PyAny>) = item?.extract()?;
                inputs.push(operand(&variable, "evaluate")?);
                let place = format!("evaluate: the value of {variable}");
                numbers.push(value.extract().map_err(|_| mistake(&value, &place, "a number"))?);
            }
        }
        let advice = "give evaluate a value of each";
        let tape = long_with_forms(py, |graph| graph.tape_or_advice(&inputs, &[self.0], advice))?;
        let (outputs, found) = raise(py, Evaluator::new(&tape).evaluate_noting(&numbers))?;
        report(py, found, "evaluate")?;
        Ok(outputs[0])
    }

    /// The same expression in `SymPy`.
    fn to_sympy<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("symbody.symbolic.sympy_bridge.structured")?.call_method1("to_sympy", (slf,))
    }

    /// LaTeX without the dollar signs.
    fn latex(&self, py: Python<'_>) -> PyResult<String> {
        long_with_forms(py, |graph| Ok(graph.to_latex(self.0)))
    }

    /// Maple's one-dimensional notation.
    fn maple(&self, py: Python<'_>) -> PyResult<String> {
        long_with_forms(py, |graph| Ok(graph.to_maple(self.0)))
    }

    fn _repr_latex_(&self, py: Python<'_>) -> PyResult<String> {
        Ok(format!("$\\displaystyle {}$", self.latex(py)?))
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        self.__str__(py)
    }

    const fn __copy__(&self) -> Self {
        *self
    }

    const fn __deepcopy__(&self, _memo: &Bound<'_, PyAny>) -> Self {
        *self
    }

    /// Whether two expressions are equal as mathematics.
    fn equals(&self, py: Python<'_>, other: &Bound<'_, PyAny>) -> PyResult<bool> {
        let other = operand(other, "equals")?;
        long_with_forms(py, |graph| Ok(graph.equal(self.0, other)))
    }

    /// Whether two expressions are one node: the same value in the same form.
    fn same_form(&self, other: &Bound<'_, PyAny>) -> PyResult<bool> {
        Ok(self.0 == operand(other, "same_form")?)
    }

    /// The node of this form.
    #[getter]
    const fn id(&self) -> u32 {
        self.0.0
    }

    /// The exact value at the random point, as 16 bytes; a digest of the values in all lanes for what holds signs or roots.
    #[getter]
    fn fingerprint<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let [a, b] = long_with_forms(py, |graph| Ok(graph.digest(self.0)))?;
        Ok(PyBytes::new(py, &[a.to_le_bytes(), b.to_le_bytes()].concat()))
    }

    /// What the node is: number, constant, symbol, `time_function`, application, sum, product, power, function,
    /// solution.
    #[getter]
    fn kind(&self) -> &'static str {
        with_forms(|graph| match graph.view(self.0) {
            View::Number(_) => "number",
            View::Pi => "constant",
            View::Time | View::Symbol(..) => "symbol",
            View::TimeFunction(..) => "time_function",
            View::Application { .. } => "application",
            View::Sum(_) => "sum",
            View::Product(factors) if factors.len() == 1 => "power",
            View::Product(_) | View::Scale(..) => "product",
            View::Function(Function::Power, _) => "power",
            View::Function(..) => "function",
            View::Solution(..) | View::LinearSystem { .. } => "solution",
        })
    }

    /// The name of a symbol, a function of time, an applied function or a constant.
    #[getter]
    fn name(&self) -> PyResult<String> {
        with_forms(|graph| match graph.view(self.0) {
            View::Time => Ok("t".to_owned()),
            View::Pi => Ok("pi".to_owned()),
            View::Symbol(name, _) | View::TimeFunction(name, ..) | View::Application { name, .. } => {
                Ok(name.to_owned())
            }
            View::Function(function, _) => Ok(function.name().to_owned()),
            _ => Err(PyAttributeError::new_err("this expression has no name")),
        })
    }

    /// How often a function of time is differentiated.
    #[getter]
    fn order(&self) -> PyResult<u32> {
        with_forms(|graph| match graph.view(self.0) {
            View::TimeFunction(_, order, _) => Ok(order),
            _ => Err(PyAttributeError::new_err("only functions of time have an order")),
        })
    }

    /// How often an undefined function is differentiated by each of its arguments.
    #[getter]
    fn orders(&self) -> PyResult<Vec<u32>> {
        with_forms(|graph| match graph.view(self.0) {
            View::Application { orders, .. } => Ok(orders.to_vec()),
            _ => Err(PyAttributeError::new_err("only undefined functions have orders")),
        })
    }

    /// The assumption about a symbol: "real", "positive", "small" or "none"; about a function of time, "real" or "small".
    #[getter]
    fn assumption(&self) -> PyResult<&'static str> {
        with_forms(|graph| match graph.view(self.0) {
            View::Symbol(_, assumption) | View::TimeFunction(_, _, assumption) => {
                Ok(assumption_name(assumption))
            }
            _ => Err(PyAttributeError::new_err("only symbols and functions of time have an assumption")),
        })
    }

    /// Terms, factors, base and exponent, or arguments.
    #[getter]
    fn args<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let parts = long_with_forms(py, |graph| parts(graph, self.0))?;
        PyTuple::new(py, parts.into_iter().map(Expr))
    }

    /// Numerator and denominator of an exact number.
    #[getter]
    fn ratio(&self) -> PyResult<(BigInt, BigInt)> {
        with_forms(|graph| graph.as_number(self.0).map(|n| (n.numerator(), n.denominator())))
            .ok_or_else(|| PyAttributeError::new_err("only numbers have a ratio"))
    }

    /// Whether a number came from doubles and prints as one.
    #[getter]
    fn is_decimal(&self) -> bool {
        with_forms(|graph| graph.as_number(self.0).is_some_and(Number::is_decimal))
    }

    #[getter]
    fn is_zero(&self) -> bool {
        self.0 == Id::ZERO
    }

    #[getter]
    fn is_number(&self) -> bool {
        with_forms(|graph| graph.as_number(self.0).is_some())
    }

    /// Whether no symbol is in the expression.
    #[getter]
    fn is_constant(&self) -> bool {
        with_forms(|graph| graph.is_constant(self.0))
    }

    #[getter]
    fn is_variable(&self) -> bool {
        with_forms(|graph| graph.is_variable(self.0))
    }

    #[getter]
    fn depends_on_time(&self) -> bool {
        with_forms(|graph| graph.depends_on_time(self.0))
    }

    /// The symbols, functions of time and their derivatives in the expression; of `f(q)`, the leaf q alone.
    #[getter]
    fn free_symbols<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyFrozenSet>> {
        leaves(py, &[self.0])
    }

    /// Whether something equal to `part` occurs in the expression.
    fn has(&self, py: Python<'_>, part: &Bound<'_, PyAny>) -> PyResult<bool> {
        let part = operand(part, "has")?;
        long_with_forms(py, |graph| Ok(graph.has(self.0, part)))
    }

    /// Pickled node by node: the form is built again, in whatever process.
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("symbody.symbolic.expression.encoding")?.call_method1("reduced", (slf,))
    }

    /// The n-th partial derivative with respect to a variable.
    #[pyo3(signature = (variable, n = Times(1)), text_signature = "($self, variable, n=1)")]
    fn diff(&self, py: Python<'_>, variable: &Bound<'_, PyAny>, n: Times) -> PyResult<Self> {
        let variable = operand(variable, "diff, variable")?;
        notice_namesakes(py, "diff", &[self.0], &[variable])?;
        long_with_graph(py, |graph| graph.diff_times(self.0, variable, n.0)).map(Self)
    }

    /// The expression with every key of the mapping replaced by its value, all at once.
    #[pyo3(signature = (mapping, *value))]
    fn subs(&self, py: Python<'_>, mapping: &Bound<'_, PyAny>, value: &Bound<'_, PyTuple>) -> PyResult<Self> {
        if !value.is_empty() {
            let message = "subs takes one mapping of variables to their values: subs({x: 1}), not subs(x, 1)";
            return Err(argument_error(py, message.to_owned()));
        }
        let pairs = pairs(mapping)?;
        notice_namesakes(py, "subs", &[self.0], &keys(&pairs))?;
        let replaced = long_with_forms(py, |graph| graph.substitute(&[self.0], &pairs))?;
        Ok(Self(replaced[0]))
    }
}

/// The Python name of an assumption.
const fn assumption_name(assumption: Assumption) -> &'static str {
    match assumption {
        Assumption::None => "none",
        Assumption::Real => "real",
        Assumption::Positive => "positive",
        Assumption::Small => "small",
    }
}

/// How often to differentiate.
struct Times(u64);

impl<'a, 'py> FromPyObject<'a, 'py> for Times {
    type Error = PyErr;

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        let times: Option<u64> = object.extract().ok();
        times.map(Self).ok_or_else(|| {
            let text = object.repr().map_or_else(|_| String::new(), |repr| repr.to_string());
            argument_error(object.py(), format!("diff: n is {text}; expected 0, 1, 2, ... derivatives"))
        })
    }
}

impl Expr {
    /// A constant, rounded by a function of Python's `math`; other expressions are an error.
    fn rounded<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        if with_forms(|graph| graph.is_constant(self.0)) {
            return py.import("math")?.call_method1(name, (self.__float__(py)?,));
        }
        py.import("symbody.symbolic.expression.ufunc")?.call_method1("refuse", (name,))
    }
}

/// The value of an expression without symbols.
fn constant_value(graph: &Graph, id: Id) -> Result<(f64, BTreeSet<Deficiency>), Error> {
    if let Some(number) = graph.as_number(id) {
        return Ok((number.to_f64(), BTreeSet::new()));
    }
    if let Some(&variable) = graph.variables(&[id]).first() {
        return Err(Error::MissingInput(format!(
            "{} has no numeric value: it contains {}; substitute values first",
            graph.to_quotation(id),
            graph.to_quotation(variable)
        )));
    }
    let tape = graph.tape(&[], &[id])?;
    let (outputs, found) = Evaluator::new(&tape).evaluate_noting(&[])?;
    Ok((outputs[0], found))
}

/// The parts of a node as expressions of their own.
fn parts(graph: &mut Graph, id: Id) -> Result<Vec<Id>, Error> {
    let factors: Vec<(Id, NumberId)> = match graph.view(id) {
        View::Sum(terms) => {
            let terms: Vec<_> = terms.iter().collect();
            return Ok(terms.into_iter().map(|(factor, node)| graph.scale(factor, node)).collect());
        }
        View::Scale(factor, child) => {
            let number = graph.get_number(factor).clone();
            return Ok(vec![graph.number(&number), child]);
        }
        View::Product(factors) => factors.iter().collect(),
        // The system is not an expression: its parts follow the number of the component.
        View::Solution(system, index) => {
            let parts = graph.children(system);
            return Ok(std::iter::once(graph.integer(i64::from(index))).chain(parts).collect());
        }
        _ => return Ok(graph.children(id)),
    };
    if let [(base, exponent)] = factors[..] {
        let exponent = graph.get_number(exponent).clone();
        return Ok(vec![base, graph.number(&exponent)]);
    }
    factors.into_iter().map(|factor| graph.product(&[factor])).collect()
}
