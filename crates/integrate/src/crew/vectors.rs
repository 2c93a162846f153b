//! Loops over all lanes, compiled for the vectors of the processor that runs them.

#![allow(unsafe_code, reason = "wider vectors, where the processor that runs this has them")]

/// A loop over lanes. Its `run` must be inlined, so that it is compiled for the vectors of its caller.
pub(super) trait Loop {
    /// Run it.
    fn run(self);
}

/// Run a loop by the widest vectors of this processor. Nothing is fused: the numbers are those of a motion alone.
pub(super) fn in_vectors<const W: usize>(work: impl Loop) {
    #[cfg(target_arch = "x86_64")]
    {
        if W == 8 && is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq") {
            // SAFETY: this processor has what the function is compiled for.
            return unsafe { by_avx512(work) };
        }
        if is_x86_feature_detected!("avx") {
            // SAFETY: this processor has what the function is compiled for.
            return unsafe { by_avx(work) };
        }
    }
    work.run();
}

/// Run a loop in vectors of eight.
///
/// # Safety
/// The processor has them.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq")]
unsafe fn by_avx512(work: impl Loop) {
    work.run();
}

/// Run a loop in vectors of four.
///
/// # Safety
/// The processor has them.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx")]
unsafe fn by_avx(work: impl Loop) {
    work.run();
}

/// Replace the numbers of some lanes.
#[allow(clippy::inline_always, reason = "what isn't inlined there isn't compiled for those vectors")]
#[inline(always)]
pub(super) fn blend<const W: usize>(old: &mut [f64; W], new: &[f64; W], chosen: &[bool; W]) {
    let mut both = *old;
    for lane in 0..W {
        both[lane] = if chosen[lane] { new[lane] } else { both[lane] };
    }
    *old = both;
}
