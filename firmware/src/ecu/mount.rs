//! Another bucket: everything built from the geometry is built again, a step a tick; only the plans of motion may take longer than one.

use core::borrow::BorrowMut;

use super::Ecu;
use crate::dig::Dig;
use crate::fence::Fence;
use crate::motion::Followers;
use crate::pose::maps;
use crate::store::StoredRecord;
use crate::travel::violation_among;
use kinematics_core::PinGeometry;

/// Ticks of the dig tried in a tick of the controller.
const DIG_TICKS: u32 = 64;

/// The buckets, and the change under way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Buckets {
    record: &'static StoredRecord,
    mounted: u8,
    /// What is being mounted: the bucket asked for, or after a failure the one before.
    next: u8,
    step: Step,
}

/// What comes next.
#[derive(Clone, Copy, Debug)]
enum Step {
    /// The maps: pose and lengths are the new bucket's from here on.
    Maps,
    /// The fence.
    Fence,
    /// The dig's travel, from this tick of it on.
    Dig(u32),
    /// Everything that motion precomputes: it may take longer than a tick, which the tick after does not hold against it.
    Plan,
}

/// With this bucket something is not possible.
struct Unusable;

impl<F: BorrowMut<Followers>> Ecu<F> {
    /// Gives the record whose buckets can be mounted by command; this one of them is mounted. Its parameters are those the application
    /// was built from.
    pub fn set_buckets(&mut self, record: &'static StoredRecord, mounted: u8) {
        self.buckets = Some(Buckets { record, mounted, next: mounted, step: Step::Maps });
        self.service().has_buckets(mounted);
    }

    pub(super) fn has_bucket(&self, bucket: u8) -> bool {
        self.buckets.is_some_and(|buckets| buckets.record.geometry_for(bucket.into()).is_some())
    }

    /// One step of the change; the service stage holds the machine disabled until it is told that a bucket is mounted.
    #[inline(never)]
    pub(super) fn mount_on(&mut self) {
        let asked = self.service.wanted_bucket();
        let Some(mut buckets) = self.buckets else { return self.service.mounted(0, false) };
        if matches!(buckets.step, Step::Maps) && buckets.next == buckets.mounted {
            buckets.next = asked;
        }
        match self.mount_step(&buckets) {
            Ok(Some(step)) => buckets.step = step,
            Ok(None) => {
                (buckets.mounted, buckets.step) = (buckets.next, Step::Maps);
                self.service.mounted(buckets.mounted, buckets.mounted == asked);
            }
            // The one before fitted once; back to it.
            Err(Unusable) if buckets.next != buckets.mounted => {
                (buckets.next, buckets.step) = (buckets.mounted, Step::Fence);
                self.put_maps(&buckets);
            }
            Err(Unusable) => {
                buckets.step = Step::Maps;
                self.service.mounted(buckets.mounted, false);
            }
        }
        self.buckets = Some(buckets);
    }

    fn mount_step(&mut self, buckets: &Buckets) -> Result<Option<Step>, Unusable> {
        let p = &buckets.record.parameters;
        Ok(match buckets.step {
            Step::Maps => {
                self.put_maps(buckets).ok_or(Unusable)?;
                Some(Step::Fence)
            }
            Step::Fence => {
                self.put_fence(buckets).ok_or(Unusable)?;
                Some(Step::Dig(0))
            }
            Step::Dig(from) => {
                let Some(dig) = p.dig.as_ref().map(Dig::new) else { return Ok(Some(Step::Plan)) };
                if violation_among(&self.machine, &dig, from, DIG_TICKS).is_some() {
                    return Err(Unusable);
                }
                let next = from.saturating_add(DIG_TICKS);
                Some(if next > dig.ticks() { Step::Plan } else { Step::Dig(next) })
            }
            Step::Plan => {
                let mut mounted = *p;
                mounted.geometry = buckets.geometry().ok_or(Unusable)?;
                self.motion.plan(&mounted, &self.machine).map_err(|_| Unusable)?;
                None
            }
        })
    }

    // Not inlined, so that a fence does not lie on the stack while motion plans.
    #[inline(never)]
    fn put_fence(&mut self, buckets: &Buckets) -> Option<()> {
        let p = &buckets.record.parameters;
        if let Some(fence) = &p.fence {
            self.fence = Some(Fence::new(fence, &buckets.geometry()?, &self.machine, &p.coils.valves()).ok()?);
        }
        Some(())
    }

    fn put_maps(&mut self, buckets: &Buckets) -> Option<()> {
        self.machine = maps(&buckets.geometry()?).ok()?;
        Some(())
    }
}

impl Buckets {
    fn geometry(&self) -> Option<PinGeometry> {
        self.record.geometry_for(self.next.into())
    }
}
