//! Coefficients that distinguish one explicit Runge–Kutta method from another.

/// The places and values of what is not zero among the weights of the stages.
pub type Row = &'static [(usize, f64)];

/// The coefficients of a method with an error estimate and a dense output.
pub struct Tableau {
    /// The power of the step that the error estimate is proportional to.
    pub order: i32,
    /// How many stages make a step; the stage after them is at its end, and further ones serve the dense output.
    pub stages: usize,
    /// Whether the error estimate needs the rates at the end of the step.
    pub evaluates_end: bool,
    /// The product of step and eigenvalue at which the method becomes unstable, a little less.
    pub stability: f64,
    /// When the stages are, in steps.
    pub c: &'static [f64],
    /// The weights of the earlier stages in each stage; those of the stage at the end are the weights of the step.
    pub a: &'static [Row],
    /// The weights in the estimate of the error: one row, or a second one of lower order that damps the first
    /// [Hairer, Nørsett & Wanner 1993, II.10].
    pub errors: &'static [Row],
    /// The weights in the terms of the dense output beyond the cubic Hermite polynomial.
    pub dense: &'static [Row],
}
