//! What is built from the geometry, and so anew for another bucket: maps, fence, plans.

use core::cell::Cell;

use kinematics_core::Machine;

use crate::dig::Dig;
use crate::fence::Fence;
use crate::motion::Followers;
use crate::parameters::{ParameterError, Parameters};
use crate::pose::maps;
use crate::travel::first_violation;

/// Everything of the application that depends on the bucket, in one memory that is filled in place: about 15 KiB. An image gives it as a
/// static, so that it never lies on the stack, and lends it whole to where a bucket is fitted.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// `None` before everything is built. The cells have no spare bit patterns, so `None` is zeros: an image needs no flash for it.
    machine: Option<Cell<Machine<f32>>>,
    fence: Option<Cell<Fence>>,
    followers: Followers,
}

/// Maps, fence and plans of a machine with its bucket.
pub(crate) type Parts<'a> = (&'a Machine<f32>, Option<&'a mut Fence>, &'a mut Followers);

impl Fitted {
    /// To nothing yet.
    pub const fn new() -> Self {
        Self { machine: None, fence: None, followers: Followers::new() }
    }

    /// Builds all of it from valid parameters; the dig's travel is tried at each of its ticks. It takes many ticks' time and kilobytes of
    /// stack.
    ///
    /// # Errors
    /// What is not possible with this geometry; nothing is fitted then.
    // Not inlined: what it needs of the stack, its callers do not.
    #[inline(never)]
    pub(crate) fn fit(&mut self, p: &Parameters) -> Result<(), ParameterError> {
        (self.machine, self.fence) = (None, None);
        let machine = maps(&p.geometry)?;
        let dig = p.dig.as_ref().map(Dig::new);
        if let Some(violation) = dig.as_ref().and_then(|dig| first_violation(&machine, dig)) {
            return Err(ParameterError::Dig(violation));
        }
        if let Some(fence) = &p.fence {
            self.fence = Some(Cell::new(Fence::new(fence, &p.geometry, &machine, &p.coils.valves())?));
        }
        self.followers.plan(p, &machine, dig)?;
        self.machine = Some(Cell::new(machine));
        Ok(())
    }

    /// What was built, or nothing.
    #[inline(always)]
    pub(crate) fn parts(&mut self) -> Option<Parts<'_>> {
        let machine = self.machine.as_mut()?.get_mut();
        Some((machine, self.fence.as_mut().map(Cell::get_mut), &mut self.followers))
    }

    /// Motion and fence start over.
    pub(crate) fn reset(&mut self) {
        self.followers.reset();
        if let Some(fence) = &mut self.fence {
            fence.get_mut().reset();
        }
    }
}

impl Default for Fitted {
    fn default() -> Self {
        Self::new()
    }
}
