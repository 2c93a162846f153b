//! Many motions of one system, in several threads.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError, mpsc};
use std::thread;
use std::time::Duration;

use crate::dynamics::Dynamics;
use crate::integrate::{Record, Run, integrate};
use crate::machine_code::MachineCode;
use crate::method::Method;
use crate::tolerances::Tolerances;

/// The time between two calls of `keep_going`.
const LOOK: Duration = Duration::from_millis(50);

/// One motion of many.
#[derive(Clone, Copy, Debug)]
pub struct Case<'a> {
    /// The state at the start.
    pub state: &'a [f64],
    /// The constants of its parameters.
    pub constants: &'a [f64],
}

/// Integrate many motions at the same instants; their states are written one motion after another.
///
/// `keep_going` is called several times per second with the number of motions that are done. When it returns false,
/// motions that have not started get no run. `notes` is called on the thread of a motion before and after it. Its
/// second result, such as deficiencies that compiled code has noted, is returned with the run.
#[allow(clippy::too_many_arguments, reason = "the arguments of an integration")]
pub fn integrate_many<N: Clone + Send>(
    dynamics: &Dynamics<MachineCode>,
    method: Method,
    cases: &[Case<'_>],
    record: Record<'_>,
    tolerances: Tolerances,
    threads: usize,
    keep_going: &mut dyn FnMut(usize) -> bool,
    notes: &(dyn Fn() -> N + Sync),
) -> Vec<Option<(Run, N)>> {
    let stop = AtomicBool::new(false);
    let done = AtomicUsize::new(0);
    let mut runs: Vec<Option<(Run, N)>> = vec![None; cases.len()];
    let Record { instants, states, trail } = record;
    let size = states.len() / cases.len().max(1);
    let work = Mutex::new(cases.iter().zip(states.chunks_mut(size.max(1))).zip(&mut runs));
    thread::scope(|scope| {
        let (working, finished) = mpsc::channel::<()>();
        for _ in 0..threads.max(1) {
            let at_work = working.clone();
            scope.spawn(|| {
                let _at_work = at_work;
                while !stop.load(Ordering::Relaxed) {
                    let next = work.lock().unwrap_or_else(PoisonError::into_inner).next();
                    let Some(((case, states), run)) = next else { break };
                    let record = Record { instants, states, trail };
                    let own = dynamics.with_constants(case.constants);
                    let mut unstopped = |_| !stop.load(Ordering::Relaxed);
                    notes();
                    let ended = integrate(&own, method, case.state, record, tolerances, &mut unstopped);
                    *run = Some((ended, notes()));
                    done.fetch_add(1, Ordering::Relaxed);
                }
            });
        }
        drop(working);
        // Nothing is sent: the channel closes when the last thread has ended.
        while finished.recv_timeout(LOOK) == Err(mpsc::RecvTimeoutError::Timeout) {
            if !keep_going(done.load(Ordering::Relaxed)) {
                stop.store(true, Ordering::Relaxed);
            }
        }
    });
    runs
}
