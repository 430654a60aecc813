//! What the tick does not do itself: it lends what is fitted to the bucket, and stays disabled until it is back.

use core::borrow::BorrowMut;

use super::Ecu;
use crate::board::Disabled;
use crate::fitted::Fitted;
use crate::service::{Done, Errand, Reason};

impl<F: BorrowMut<Fitted>> Ecu<F> {
    /// There is a store, whose record has this many buckets and had this one of them mounted when the application was built from it; whoever
    /// says so runs the errands. Without it no bucket can be mounted and nothing kept.
    pub fn set_buckets(&mut self, count: u8, mounted: u8) {
        self.service.set_buckets(count, mounted);
    }

    /// An errand waits for a proof that nothing can move.
    #[inline(always)]
    pub fn errand_is_due(&self) -> bool {
        self.service.errand_is_due()
    }

    /// The errand that is due, for a place of lower priority than the tick. Until [`Self::done`] every tick holds everything off.
    pub fn errand(&mut self, permit: Disabled) -> Option<Errand<F>> {
        let job = self.service.send()?;
        let fitted = if job.is_mount() { self.fitted.take() } else { None };
        Some(Errand::new(job, fitted, permit))
    }

    /// The board cannot be proved disabled: the errand that was due is refused.
    pub fn not_disabled(&mut self) {
        self.service.returned(None, Err(Reason::Enabled));
    }

    /// An errand is back.
    pub fn done(&mut self, done: Done<F>) {
        let Done { fitted, mounted, outcome, .. } = done;
        self.fitted = fitted.or(self.fitted.take());
        self.service.returned(mounted, outcome);
    }
}
