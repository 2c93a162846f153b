//! Compiled functions of time and state, at given addresses.

#![allow(
    unsafe_code,
    reason = "machine code is known by its address; whoever makes a `MachineCode` vouches for it and for its lengths"
)]

use std::cell::RefCell;

use crate::lane::Lane;

/// Machine code `void f(const double *in, double *out)` with `in = (t, state, constants)`.
#[derive(Clone, Copy, Debug)]
pub struct MachineCode {
    address: usize,
    states: usize,
    constants: usize,
    outputs: usize,
    vector: Option<VectorCode>,
}

/// The same function of several states, one in each lane of the vectors: number k of lane i is at `k * lanes + i`.
#[derive(Clone, Copy, Debug)]
struct VectorCode {
    address: usize,
    /// How many conditions follow the outputs: a lane holds the outputs only where all of them are positive.
    conditions: usize,
}

impl MachineCode {
    /// The code at an address.
    ///
    /// # Safety
    /// Such a function is at the address and stays there. It reads 1 + `states` + `constants` doubles, writes `outputs`
    /// doubles, and may run in several threads.
    pub unsafe fn new(address: usize, states: usize, constants: usize, outputs: usize) -> Self {
        Self { address, states, constants, outputs, vector: None }
    }

    /// The same code, with a function of several states at a time at another address.
    ///
    /// # Safety
    /// Such a function is at the address and stays there. It reads and writes vectors where the other one reads and
    /// writes doubles, and writes `conditions` vectors more. Their width is that of the lanes which call it.
    #[must_use]
    pub unsafe fn with_vectors(self, address: usize, conditions: usize) -> Self {
        Self { vector: Some(VectorCode { address, conditions }), ..self }
    }

    /// The number of constants that it reads.
    pub fn constants(&self) -> usize {
        self.constants
    }

    /// The number of values that it writes.
    pub fn outputs(&self) -> usize {
        self.outputs
    }

    /// The number of values that it reads.
    pub(crate) fn inputs(&self) -> usize {
        1 + self.states + self.constants
    }

    /// The number of conditions of the function of several states, if there is one.
    pub(crate) fn conditions(&self) -> Option<usize> {
        self.vector.map(|vector| vector.conditions)
    }

    /// Write the values for one state.
    pub(crate) fn call(&self, inputs: &[f64], out: &mut [f64]) {
        assert_eq!(inputs.len(), self.inputs(), "the inputs of compiled code");
        assert_eq!(out.len(), self.outputs, "the outputs of compiled code");
        // SAFETY: the caller of `new` guarantees the function, for the lengths that are checked above.
        unsafe { function(self.address)(inputs.as_ptr(), out.as_mut_ptr()) }
    }

    /// Write the values and the conditions for a state in each lane.
    ///
    /// # Panics
    /// If there is no such function, or the lengths are not those of the code.
    pub(crate) fn call_vectors<const W: usize>(&self, inputs: &[[f64; W]], out: &mut [[f64; W]]) {
        let vector = self.vector.expect("code of several states");
        assert_eq!(inputs.len(), self.inputs(), "the inputs of compiled code");
        assert_eq!(out.len(), self.outputs + vector.conditions, "the outputs of compiled code");
        // SAFETY: the caller of `with_vectors` guarantees the function, for the lengths that are checked above.
        unsafe { function(vector.address)(inputs.as_ptr().cast(), out.as_mut_ptr().cast()) }
    }
}

/// The function at an address.
///
/// # Safety
/// It is there.
unsafe fn function(address: usize) -> unsafe extern "C" fn(*const f64, *mut f64) {
    // SAFETY: see above.
    unsafe { std::mem::transmute(address) }
}

/// Machine code bound to the constants of one set of parameters: a function of time and state.
#[derive(Clone, Debug)]
pub struct BoundCode {
    code: MachineCode,
    inputs: RefCell<Vec<f64>>,
    /// Where it is evaluated together with other motions, if it is.
    lane: Option<Lane>,
}

impl BoundCode {
    /// Bind machine code to constants.
    ///
    /// # Panics
    /// If the number of constants is not the number that the code reads.
    pub fn new(code: MachineCode, constants: &[f64]) -> Self {
        assert_eq!(constants.len(), code.constants, "constants of compiled code");
        let mut inputs = Vec::with_capacity(1 + code.states + constants.len());
        inputs.resize(1 + code.states, 0.0);
        inputs.extend_from_slice(constants);
        Self { code, inputs: RefCell::new(inputs), lane: None }
    }

    /// Bind machine code to constants, and to a lane if it has a function of several states.
    pub(crate) fn in_lane(code: MachineCode, constants: &[f64], lane: &Lane, place: usize) -> Self {
        let lane = code.vector.map(|_| lane.of_function(place, constants));
        Self { lane, ..Self::new(code, constants) }
    }

    /// The number of values that it writes.
    pub fn outputs(&self) -> usize {
        self.code.outputs
    }

    /// The length of an instant and a state.
    pub(crate) fn inputs(&self) -> usize {
        1 + self.code.states
    }

    /// The lane in which it is evaluated.
    pub(crate) fn lane(&self) -> Option<&Lane> {
        self.lane.as_ref()
    }

    /// Write the values at an instant and a state.
    ///
    /// # Panics
    /// If the length of the state or of the outputs is not that of the code.
    pub fn call(&self, t: f64, state: &[f64], out: &mut [f64]) {
        assert_eq!(state.len(), self.code.states, "the state of compiled code");
        assert_eq!(out.len(), self.code.outputs, "the outputs of compiled code");
        if let Some(lane) = &self.lane {
            if lane.shares_functions() {
                return lane.evaluate(t, state, out);
            }
            if self.code.conditions() != Some(0) {
                lane.note_code_for_one();
            }
        }
        let mut inputs = self.inputs.borrow_mut();
        inputs[0] = t;
        inputs[1..=state.len()].copy_from_slice(state);
        self.code.call(&inputs, out);
    }

    /// Write the values at several states: rows of an instant and a state, and rows of values.
    pub(crate) fn call_rows(&self, rows: &[f64], out: &mut [f64]) {
        let width = 1 + self.code.states;
        assert_eq!(rows.len() / width * self.code.outputs, out.len(), "the outputs of compiled code");
        // One state alone is evaluated sooner by the code for one.
        let is_one = rows.len() == width;
        if let Some(lane) = self.lane.as_ref().filter(|lane| !is_one || lane.shares_functions()) {
            return lane.evaluate_rows(rows, &self.inputs.borrow()[width..], out);
        }
        for (row, out) in rows.chunks(width).zip(out.chunks_mut(self.code.outputs)) {
            self.call(row[0], &row[1..], out);
        }
    }
}
