//! The task of `ecu-emulated`, and a watchdog: a second timer that nothing but a fed watchdog sets back.

#[rtic::app(device = stm32f4::stm32f405, peripherals = true)]
mod app {
    use crate::emulated::exit::{code, end};
    use crate::emulated::link::LinkLost;
    use crate::emulated::stopwatch::Stopwatch;
    use crate::emulated::{fail, succeed};
    use crate::session::Session;
    use crate::spoil::flip;
    use crate::target::constant_watch::{CORRUPT, ConstantWatch};
    use crate::{safe_state, target};
    use core::cmp::max;
    use defmt_rtt as _;
    use firmware::Fitted;
    use firmware::simulated::link::{Request, Spoil, Zone};
    use stm32f4::stm32f405::{TIM2, TIM3};

    /// As in `ecu-emulated`.
    const PERIOD_COUNTS: u32 = 1_000_000;
    /// The board's watchdog waits 50 ms.
    const WATCHDOG_COUNTS: u32 = 50 * PERIOD_COUNTS;

    #[shared]
    struct Shared {}

    #[local]
    struct Local {
        session: Session,
        watch: Watch,
        timer: TIM2,
        watchdog: TIM3,
    }

    /// The watch, and the most instructions that a look of it took once it had begun.
    pub(crate) struct Watch {
        constants: ConstantWatch,
        instructions: u32,
    }

    #[init(local = [fitted: Fitted = Fitted::new()])]
    fn init(mut cx: init::Context) -> (Shared, Local) {
        target::stack_guard::arm(&mut cx.core.MPU);
        let Ok(session) = Session::open(Stopwatch::start(cx.device.TIM5), cx.local.fitted) else { fail() };
        let (timer, watchdog) = (cx.device.TIM2, cx.device.TIM3);
        timer.arr().write(|w| w.arr().set(PERIOD_COUNTS));
        timer.dier().write(|w| w.uie().enabled());
        timer.cr1().write(|w| w.cen().enabled());
        // SAFETY: the emulator's timers have 32 bits, of which the register crate knows sixteen.
        watchdog.arr().write(|w| unsafe { w.bits(WATCHDOG_COUNTS) });
        watchdog.dier().write(|w| w.uie().enabled());
        watchdog.cr1().write(|w| w.cen().enabled());
        (
            Shared {},
            Local { session, watch: Watch { constants: ConstantWatch::new(), instructions: 0 }, timer, watchdog },
        )
    }

    #[idle]
    fn idle(_: idle::Context) -> ! {
        loop {
            cortex_m::asm::wfi();
        }
    }

    /// Nobody fed it for 50 ms. On the board the chip is reset: no code runs, and the pins float.
    #[task(binds = TIM3, priority = 2)]
    fn bite(_: bite::Context) {
        end(code::WATCHDOG);
    }

    #[task(binds = TIM2, priority = 1, local = [session, watch, timer, watchdog, lose: u32 = 0])]
    fn tick(cx: tick::Context) {
        let tick::LocalResources { session, watch, timer, watchdog, lose, .. } = cx.local;
        let started_ns = session.stopwatch.now_ns();
        timer.sr().modify(|_, w| w.uif().clear());
        if *lose > 0 {
            // As if it had not come.
            *lose -= 1;
            return;
        }
        loop {
            match exchange(session, watch, started_ns) {
                Ok(Done::Tick { fed }) => {
                    if fed {
                        // SAFETY: any count.
                        watchdog.cnt().write(|w| unsafe { w.bits(0) });
                    }
                    return;
                }
                Ok(Done::Spoilt) => {}
                Ok(Done::Lost(u32::MAX)) => {
                    timer.dier().write(|w| w.uie().disabled());
                    return;
                }
                Ok(Done::Lost(ticks)) => {
                    // This one is the first that is lost.
                    *lose = ticks.saturating_sub(1);
                    return;
                }
                Err(LinkLost) => safe_state::halt(&|| ()),
            }
        }
    }

    /// What was done.
    enum Done {
        Tick { fed: bool },
        Spoilt,
        Lost(u32),
    }

    fn exchange(session: &mut Session, watch: &mut Watch, started_ns: u32) -> Result<Done, LinkLost> {
        match session.request()? {
            Request::Tick(wires) => {
                let fed = session.tick(&wires, started_ns)?;
                let had_begun = watch.constants.has_begun();
                let before = session.stopwatch.now_ns();
                let sound = watch.constants.look(session.controller.ecu());
                let after = session.stopwatch.now_ns();
                if had_begun {
                    watch.instructions = max(watch.instructions, session.stopwatch.instructions(before, after));
                }
                if !sound {
                    session.controller.self_tested(&CORRUPT);
                }
                Ok(Done::Tick { fed })
            }
            Request::End => {
                session.link.write(&watch.instructions.to_le_bytes())?;
                succeed();
            }
            Request::Spoil(Spoil::Flip { byte, bit }) => {
                let zone = flip(session, &watch.constants, byte, bit);
                session.link.write(&zone.code().to_le_bytes())?;
                Ok(Done::Spoilt)
            }
            Request::Spoil(Spoil::LoseTicks(ticks)) => {
                session.link.write(&Zone::State.code().to_le_bytes())?;
                Ok(Done::Lost(ticks))
            }
        }
    }
}
