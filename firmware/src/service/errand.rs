//! What service does beside the tick, at a lower priority: it may take many ticks, and the flash stands still for hundreds.
//!
//! The tick that is asked for it holds everything off, its board proves that, and what is fitted to the bucket is lent away:
//!
//! ```text
//! tick: Controller::errand ──▶ Errand::run (load, fit, write) ──▶ Controller::done :tick
//!       every tick between them: currents zero, cut-off open, no pose, the answer `under_way`
//! ```

use core::borrow::BorrowMut;

use embedded_storage::nor_flash::NorFlash;

use super::answer::Reason;
use super::found::Found;
use super::keep::{KeepError, keep, write};
use crate::board::Disabled;
use crate::fitted::Fitted;
use crate::store::Store;

/// What is to be done.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Job {
    /// This bucket, or after a failure again the one before.
    Mount { bucket: u8, before: u8 },
    /// This, found with this bucket.
    Keep { found: Found, bucket: u8 },
}

impl Job {
    pub(crate) fn is_mount(&self) -> bool {
        matches!(self, Self::Mount { .. })
    }
}

/// An errand under way, with the proof that nothing can move. Who drops it leaves the controller disabled.
#[derive(Debug)]
pub struct Errand<F> {
    job: Job,
    fitted: Option<F>,
    permit: Disabled,
}

/// An errand done, for [`crate::board::Controller::done`].
#[derive(Debug)]
pub struct Done<F> {
    pub(crate) fitted: Option<F>,
    /// The mounted bucket, where one was to be mounted.
    pub(crate) mounted: Option<u8>,
    pub(crate) outcome: Result<(), Reason>,
    _permit: Disabled,
}

impl<F: BorrowMut<Fitted>> Errand<F> {
    pub(crate) fn new(job: Job, fitted: Option<F>, permit: Disabled) -> Self {
        Self { job, fitted, permit }
    }

    /// Runs it. Whatever happens meanwhile, the store holds the record before or the new one.
    // Not inlined: its stack is stated by itself.
    #[inline(never)]
    pub fn run<S: NorFlash>(mut self, store: &mut Store<S>) -> Done<F> {
        let (mounted, outcome) = match (&self.job, &mut self.fitted) {
            (Job::Mount { bucket, before }, Some(fitted)) => {
                let outcome = mount((*bucket, *before), fitted.borrow_mut(), store, &self.permit);
                (Some(if outcome.is_ok() { *bucket } else { *before }), outcome)
            }
            (Job::Mount { before, .. }, None) => (Some(*before), Err(Reason::BucketUnusable)),
            (Job::Keep { found, bucket }, _) => {
                let kept = keep(found, (*bucket).into(), store, &self.permit);
                (None, kept.map(|_| ()).map_err(|_| Reason::NotStored))
            }
        };
        Done { fitted: self.fitted, mounted, outcome, _permit: self.permit }
    }
}

/// Fits the bucket and notes in the store that it is mounted. If either fails, the one before, which fitted once, is fitted again.
fn mount<S: NorFlash>(
    (bucket, before): (u8, u8),
    fitted: &mut Fitted,
    store: &mut Store<S>,
    permit: &Disabled,
) -> Result<(), Reason> {
    let outcome = fit(bucket, fitted, store).and_then(|()| note(bucket, store, permit));
    if outcome.is_err() {
        // Should even this fail, nothing is fitted, and the controller says so in every tick.
        let _ = fit(before, fitted, store);
    }
    outcome
}

#[inline(never)]
fn fit<S: NorFlash>(bucket: u8, fitted: &mut Fitted, store: &mut Store<S>) -> Result<(), Reason> {
    let loaded = store.load().map_err(|_| Reason::NotStored)?;
    let parameters = loaded.record.parameters_for(bucket.into()).map_err(|_| Reason::BucketUnusable)?;
    fitted.fit(&parameters).map_err(|_| Reason::BucketUnusable)
}

#[inline(never)]
fn note<S: NorFlash>(bucket: u8, store: &mut Store<S>, permit: &Disabled) -> Result<(), Reason> {
    if mounted_in(store) != Some(bucket) {
        // What counts is what the next start will find, be it in one sector only.
        let _ = rewrite(bucket, store, permit);
    }
    if mounted_in(store) == Some(bucket) { Ok(()) } else { Err(Reason::NotStored) }
}

#[inline(never)]
fn mounted_in<S: NorFlash>(store: &mut Store<S>) -> Option<u8> {
    store.load().ok().map(|loaded| loaded.record.mounted)
}

#[inline(never)]
fn rewrite<S: NorFlash>(bucket: u8, store: &mut Store<S>, permit: &Disabled) -> Result<u32, KeepError> {
    let mut record = store.load().map_err(KeepError::Load)?.record;
    record.mounted = bucket;
    write(&record, store, permit)
}
