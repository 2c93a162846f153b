//! Many motions of one system, in several threads.

use std::cell::RefCell;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError, mpsc};
use std::thread;
use std::time::Duration;

use crate::crew::run_crew;
use crate::dynamics::Dynamics;
use crate::integrate::{Record, Run, integrate};
use crate::lane::Lane;
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

/// A run, and what `notes` has returned of its motion.
pub type Noted<N> = (Run, Vec<N>);

/// Integrate many motions at the same instants; their states are written one motion after another.
///
/// `keep_going` is called several times per second with the number of motions that are done. When it returns false,
/// motions that have not started get no run. `notes` returns what compiled code has noted on its thread since the last
/// call, such as deficient linear systems; it is returned with the run that it belongs to.
///
/// Each thread takes `lanes` motions at a time in lock-step, if there are so many lanes in the compiled functions and the
/// method is explicit.
#[allow(clippy::too_many_arguments, reason = "the arguments of an integration")]
pub fn integrate_many<N: Clone + PartialEq + Send>(
    dynamics: &Dynamics<MachineCode>,
    method: Method,
    cases: &[Case<'_>],
    record: Record<'_>,
    tolerances: Tolerances,
    (threads, lanes): (usize, usize),
    keep_going: &mut dyn FnMut(usize) -> bool,
    notes: &(dyn Fn() -> Vec<N> + Sync),
) -> Vec<Option<Noted<N>>> {
    let stop = AtomicBool::new(false);
    let done = AtomicUsize::new(0);
    let mut runs: Vec<Option<Noted<N>>> = vec![None; cases.len()];
    let Record { instants, states, trail } = record;
    let size = states.len() / cases.len().max(1);
    let work = Mutex::new(cases.iter().zip(states.chunks_mut(size.max(1))).zip(&mut runs));
    // Takes motions as long as there are any; a motion is alone on its thread, or in a lane.
    let take = |lane: Option<&Lane>, noted: &RefCell<Vec<N>>| {
        while !stop.load(Ordering::Relaxed) {
            let next = work.lock().unwrap_or_else(PoisonError::into_inner).next();
            let Some(((case, states), run)) = next else { break };
            let record = Record { instants, states, trail };
            let own = match lane {
                Some(lane) => dynamics.in_lane(case.constants, lane),
                None => dynamics.with_constants(case.constants),
            };
            let mut unstopped = |_| !stop.load(Ordering::Relaxed);
            notes();
            noted.take();
            let ended = integrate(&own, method, case.state, record, tolerances, &mut unstopped);
            keep(noted, notes());
            *run = Some((ended, noted.take()));
            done.fetch_add(1, Ordering::Relaxed);
        }
    };
    let tableau = method.tableau().filter(|_| lanes > 1 && dynamics.rates.conditions().is_some());
    thread::scope(|scope| {
        let (working, finished) = mpsc::channel::<()>();
        for _ in 0..threads.max(1) {
            let at_work = working.clone();
            scope.spawn(|| {
                let _at_work = at_work;
                let Some(tableau) = tableau else { return take(None, &RefCell::default()) };
                let noted: Vec<RefCell<Vec<N>>> = vec![RefCell::default(); lanes];
                let job = |lane: &Lane| take(Some(lane), &noted[lane.number()]);
                run_crew(lanes, dynamics, (tableau, tolerances), &job, &mut |lane| {
                    keep(&noted[lane], notes());
                });
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

/// Add what was noted for the first time.
fn keep<N: PartialEq>(noted: &RefCell<Vec<N>>, new: Vec<N>) {
    let mut noted = noted.borrow_mut();
    for note in new {
        if !noted.contains(&note) {
            noted.push(note);
        }
    }
}
