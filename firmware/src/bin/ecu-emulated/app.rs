//! One task on a hardware timer: wires in, the drivers on their simulated chips, the tick, pins out.

#[rtic::app(device = stm32f4::stm32f405, peripherals = true)]
mod app {
    use crate::emulated::link::LinkLost;
    use crate::emulated::session::Session;
    use crate::emulated::stopwatch::Stopwatch;
    use crate::emulated::{fail, stack, succeed};
    use firmware::Fitted;
    use firmware::simulated::link::Request;
    use stm32f4::stm32f405::TIM2;

    /// The emulator clocks TIM2 at 1 GHz, and starts over after as many counts as the register says (the chip: one more).
    const PERIOD_COUNTS: u32 = 1_000_000;

    #[shared]
    struct Shared {}

    #[local]
    struct Local {
        session: Session,
        timer: TIM2,
    }

    #[init(local = [fitted: Fitted = Fitted::new()])]
    fn init(cx: init::Context) -> (Shared, Local) {
        let Ok(session) = Session::open(Stopwatch::start(cx.device.TIM5), cx.local.fitted) else { fail() };
        let timer = cx.device.TIM2;
        timer.arr().write(|w| w.arr().set(PERIOD_COUNTS));
        timer.dier().write(|w| w.uie().enabled());
        timer.cr1().write(|w| w.cen().enabled());
        (Shared {}, Local { session, timer })
    }

    #[idle]
    fn idle(_: idle::Context) -> ! {
        loop {
            cortex_m::asm::wfi();
        }
    }

    #[task(binds = TIM2, local = [session, timer])]
    fn tick(cx: tick::Context) {
        let tick::LocalResources { session, timer, .. } = cx.local;
        let started_ns = session.stopwatch.now_ns();
        timer.sr().modify(|_, w| w.uif().clear());
        if exchange(session, started_ns).is_err() {
            fail();
        }
    }

    /// One exchange with the harness.
    fn exchange(session: &mut Session, started_ns: u32) -> Result<(), LinkLost> {
        match session.request()? {
            Request::Tick(wires) => session.tick(&wires, started_ns).map(drop),
            Request::End => {
                session.link.write(&stack::peak_bytes().to_le_bytes())?;
                succeed();
            }
            // Only the image that is spoilt has these.
            Request::Spoil(_) => Err(LinkLost),
        }
    }
}
