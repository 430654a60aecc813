//! Harness and emulator on one core: they work in turn, and a wake-up across cores costs more than a tick.

/// Keeps the calling thread, and processes it starts, on the core it runs on, until dropped. Where the system has no such
/// call, or refuses it, nothing changes but the speed.
pub(super) struct OneCore {
    #[cfg(target_os = "linux")]
    before: Option<rustix::thread::CpuSet>,
    /// Given back by the thread that took it.
    _this_thread: std::marker::PhantomData<*const ()>,
}

impl OneCore {
    #[cfg(target_os = "linux")]
    pub(super) fn take() -> Self {
        use rustix::thread::{CpuSet, sched_getaffinity, sched_getcpu, sched_setaffinity};
        let mut here = CpuSet::new();
        here.set(sched_getcpu());
        let before = sched_getaffinity(None).ok().filter(|_| sched_setaffinity(None, &here).is_ok());
        Self { before, _this_thread: std::marker::PhantomData }
    }

    #[cfg(not(target_os = "linux"))]
    pub(super) fn take() -> Self {
        Self { _this_thread: std::marker::PhantomData }
    }
}

#[cfg(target_os = "linux")]
impl Drop for OneCore {
    fn drop(&mut self) {
        if let Some(before) = &self.before {
            // A refusal leaves the thread on one core: slower, never wrong.
            let _ = rustix::thread::sched_setaffinity(None, before);
        }
    }
}
