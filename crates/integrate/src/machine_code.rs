//! Compiled functions of time and state, at given addresses.

#![allow(
    unsafe_code,
    reason = "machine code is known by its address; whoever makes a `MachineCode` vouches for it and for its lengths"
)]

use std::cell::RefCell;

/// Machine code `void f(const double *in, double *out)` with `in = (t, state, constants)`.
#[derive(Clone, Copy, Debug)]
pub struct MachineCode {
    address: usize,
    states: usize,
    constants: usize,
    outputs: usize,
}

impl MachineCode {
    /// The code at an address.
    ///
    /// # Safety
    /// Such a function is at the address and stays there. It reads 1 + `states` + `constants` doubles, writes `outputs`
    /// doubles, and may run in several threads.
    pub unsafe fn new(address: usize, states: usize, constants: usize, outputs: usize) -> Self {
        Self { address, states, constants, outputs }
    }

    /// The number of constants that it reads.
    pub fn constants(&self) -> usize {
        self.constants
    }

    /// The number of values that it writes.
    pub fn outputs(&self) -> usize {
        self.outputs
    }
}

/// Machine code bound to the constants of one set of parameters: a function of time and state.
#[derive(Clone, Debug)]
pub struct BoundCode {
    code: MachineCode,
    inputs: RefCell<Vec<f64>>,
}

impl BoundCode {
    /// Bind machine code to constants.
    ///
    /// # Panics
    /// If the number of constants is not the number that the code reads.
    pub fn new(code: MachineCode, constants: &[f64]) -> Self {
        assert_eq!(constants.len(), code.constants, "constants of compiled code");
        let mut inputs = vec![0.0; 1 + code.states];
        inputs.extend_from_slice(constants);
        Self { code, inputs: RefCell::new(inputs) }
    }

    /// The number of values that it writes.
    pub fn outputs(&self) -> usize {
        self.code.outputs
    }

    /// Write the values at an instant and a state.
    ///
    /// # Panics
    /// If the length of the state or of the outputs is not that of the code.
    pub fn call(&self, t: f64, state: &[f64], out: &mut [f64]) {
        assert_eq!(state.len(), self.code.states, "the state of compiled code");
        assert_eq!(out.len(), self.code.outputs, "the outputs of compiled code");
        let mut inputs = self.inputs.borrow_mut();
        inputs[0] = t;
        inputs[1..=state.len()].copy_from_slice(state);
        // SAFETY: the caller of `MachineCode::new` guarantees the function, for the lengths that are checked above.
        unsafe {
            let function: unsafe extern "C" fn(*const f64, *mut f64) = std::mem::transmute(self.code.address);
            function(inputs.as_ptr(), out.as_mut_ptr());
        }
    }
}
