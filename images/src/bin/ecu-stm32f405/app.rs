//! One task on a hardware timer: the whole sequence, and last the watchdog. Everything else waits for it.

#[rtic::app(device = stm32f4xx_hal::pac, peripherals = true)]
mod app {
    use crate::flash::ParameterFlash;
    use crate::pins::{self, Chips, Ecu405, StartError};
    use crate::{log, safe_state, target};
    use cortex_m::singleton;
    use firmware::board::Controller;
    use firmware::board::start_up::{memory_holds, quiet_code, try_outputs};
    use firmware::can::address::{Addresses, Name};
    use firmware::store::Store;
    use firmware::supervisor::Check;
    use firmware::{Followers, Parameters, SelfTest, TICKS_PER_S};
    use stm32f4xx_hal::pac::TIM2;
    use stm32f4xx_hal::prelude::*;
    use stm32f4xx_hal::timer::{CounterHz, Event, Flag};

    /// A maker sets its own code from SAE and numbers its controllers; 0 is nobody's.
    const NAME: Name = Name { identity: 1, manufacturer: 0, ecu_instance: 0, function_instance: 0 };

    /// The bucket on the machine at power-up.
    const BUCKET: usize = 0;

    const CYCLES_PER_MS: u32 = 168_000;

    #[shared]
    struct Shared {}

    #[local]
    struct Local {
        board: Ecu405,
        controller: &'static mut Controller<&'static mut Followers>,
        timer: CounterHz<TIM2>,
    }

    #[init(local = [followers: Followers = Followers::new(), block: [u32; 1024] = [0; 1024]])]
    fn init(mut cx: init::Context) -> (Shared, Local) {
        target::stack_guard::arm(&mut cx.core.MPU);
        let mut rcc = pins::clocks(cx.device.RCC);
        // Outputs off and cut-off open come before anything that can fail.
        let (gpio, outputs) = pins::outputs_off(
            (cx.device.GPIOA, cx.device.GPIOB, cx.device.GPIOC),
            (cx.device.TIM3, cx.device.TIM4),
            &mut rcc,
        );
        let parameters = parameters(ParameterFlash::new(cx.device.FLASH));
        let (controller, quiet_code) = (controller(&parameters, cx.local.followers), quiet_code(&parameters.coils));
        let chips = Chips { spi: cx.device.SPI1, dma: cx.device.DMA2, can: cx.device.CAN1, watchdog: cx.device.IWDG };
        let mut board = match pins::start(chips, gpio, outputs, &mut rcc) {
            Ok(board) => board,
            Err(StartError::Twice) => safe_state::halt(&|| defmt::error!("started twice")),
            Err(StartError::Adc(chip)) => safe_state::halt(&|| defmt::error!("converter {} does not start", chip)),
        };
        let [drivers, cut_off] = try_outputs(&mut board, quiet_code, || cortex_m::asm::delay(CYCLES_PER_MS));
        controller.self_tested(&SelfTest {
            // Neither gets here with a wrong CRC or a converter that cannot be set up.
            parameters: Check::Passed,
            converters: Check::Passed,
            memory: memory_holds(cx.local.block),
            drivers,
            cut_off,
        });
        let mut timer = cx.device.TIM2.counter_hz(&mut rcc);
        if timer.start(TICKS_PER_S.Hz()).is_err() {
            safe_state::halt(&|| defmt::error!("no such tick rate"));
        }
        timer.listen(Event::Update);
        (Shared {}, Local { board, controller, timer })
    }

    /// The stored parameters; without them nothing ever moves. Not inlined, nor is [`controller`]: one's values are off the stack before the
    /// other's come.
    #[inline(never)]
    fn parameters(flash: ParameterFlash) -> Parameters {
        let Ok(mut store) = Store::new(flash) else { safe_state::halt(&|| defmt::error!("no store in these sectors")) };
        let Ok(loaded) = store.load() else { safe_state::halt(&|| defmt::error!("no approved parameters in flash")) };
        let Ok(parameters) = loaded.record.parameters_for(BUCKET) else {
            safe_state::halt(&|| defmt::error!("no such bucket"))
        };
        parameters
    }

    #[inline(never)]
    fn controller(
        parameters: &Parameters,
        followers: &'static mut Followers,
    ) -> &'static mut Controller<&'static mut Followers> {
        let Ok(controller) = Controller::with(parameters, Addresses::DEFAULT, &NAME, followers) else {
            safe_state::halt(&|| defmt::error!("the parameters are refused"))
        };
        let placed = singleton!(: Controller<&'static mut Followers> = controller);
        placed.unwrap_or_else(|| safe_state::halt(&|| defmt::error!("started twice")))
    }

    #[idle]
    fn idle(_: idle::Context) -> ! {
        let mut said = None;
        loop {
            cortex_m::asm::wfi();
            said = log::say_changes(said);
        }
    }

    #[task(binds = TIM2, local = [board, controller, timer, late: bool = false])]
    fn tick(cx: tick::Context) {
        let tick::LocalResources { board, controller, timer, late, .. } = cx.local;
        timer.clear_flags(Flag::Update);
        let inputs = controller.read(board, *late);
        let outputs = control_tick::tick(controller, &inputs);
        controller.write(board, &outputs);
        log::leave(&outputs);
        // The next period has begun already: this one ended too late, and the next tick says so.
        *late = timer.flags().contains(Flag::Update);
    }
}
