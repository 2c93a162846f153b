//! The numbers of one compiled function, a state in each lane.

use crate::machine_code::MachineCode;

/// The inputs and outputs of a function: a vector for each number, a lane for each state.
pub(super) struct Columns<const W: usize> {
    code: MachineCode,
    conditions: usize,
    /// Time, state and constants.
    pub inputs: Vec<[f64; W]>,
    pub outputs: Vec<[f64; W]>,
    /// The values and the conditions.
    all: Vec<[f64; W]>,
}

/// The lanes that wait for an evaluation; `noted` is called each time after the code for one state was run for one.
pub(super) struct Waiting<'a, const W: usize> {
    pub lanes: [bool; W],
    pub noted: &'a mut dyn FnMut(usize),
}

impl<const W: usize> Columns<W> {
    /// The columns of a function; `None` if it has no code for several states.
    pub fn of(code: &MachineCode) -> Option<Self> {
        code.conditions().map(|conditions| Self {
            code: *code,
            conditions,
            inputs: vec![[0.0; W]; code.inputs()],
            outputs: vec![[0.0; W]; code.outputs()],
            all: Vec::new(),
        })
    }

    /// Evaluate the states of all lanes.
    pub fn evaluate(&mut self, waiting: &mut Waiting<'_, W>) {
        let mut outputs = std::mem::take(&mut self.outputs);
        self.evaluate_into(&mut outputs, waiting);
        self.outputs = outputs;
    }

    /// Write the values for several states of one motion: rows of an instant and a state, and rows of values.
    pub fn evaluate_rows(
        &mut self,
        rows: &[f64],
        constants: &[f64],
        out: &mut [f64],
        noted: &mut dyn FnMut(usize),
    ) {
        let (width, outputs) = (self.inputs.len() - constants.len(), self.outputs.len());
        for (column, constant) in self.inputs[width..].iter_mut().zip(constants) {
            *column = [*constant; W];
        }
        for (rows, out) in rows.chunks(W * width).zip(out.chunks_mut(W * outputs)) {
            for (lane, row) in rows.chunks(width).enumerate() {
                write(lane, row, &mut self.inputs[..width]);
            }
            let count = rows.len() / width;
            self.evaluate(&mut Waiting {
                lanes: std::array::from_fn(|lane| lane < count),
                noted: &mut *noted,
            });
            for (lane, out) in out.chunks_mut(outputs).enumerate() {
                read(lane, &self.outputs, out);
            }
        }
    }

    /// Write the values for the states of all lanes; where conditions ask for it, for one state after another.
    pub fn evaluate_into(&mut self, values: &mut [[f64; W]], waiting: &mut Waiting<'_, W>) {
        if self.conditions == 0 {
            return self.code.call_vectors(&self.inputs, values);
        }
        let count = values.len();
        self.all.resize(count + self.conditions, [0.0; W]);
        self.code.call_vectors(&self.inputs, &mut self.all);
        values.copy_from_slice(&self.all[..count]);
        for lane in (0..W).filter(|&lane| waiting.lanes[lane]) {
            // NaN is not positive.
            if !self.all[count..].iter().all(|condition| condition[lane] > 0.0) {
                let inputs: Vec<f64> = self.inputs.iter().map(|column| column[lane]).collect();
                let mut own = vec![0.0; count];
                self.code.call(&inputs, &mut own);
                write(lane, &own, values);
                (waiting.noted)(lane);
            }
        }
    }
}

/// Write numbers to a lane.
pub(super) fn write<const W: usize>(lane: usize, numbers: &[f64], columns: &mut [[f64; W]]) {
    for (column, number) in columns.iter_mut().zip(numbers) {
        column[lane] = *number;
    }
}

/// Read the numbers of a lane.
pub(super) fn read<const W: usize>(lane: usize, columns: &[[f64; W]], numbers: &mut [f64]) {
    for (number, column) in numbers.iter_mut().zip(columns) {
        *number = column[lane];
    }
}
