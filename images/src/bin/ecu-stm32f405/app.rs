//! One task on a hardware timer: the whole sequence, and last the watchdog. Everything else waits for it: the idle loop runs the errands
//! that take longer than a tick, another bucket and writing the flash, and says what has changed.

#[rtic::app(device = stm32f4xx_hal::pac, peripherals = true)]
mod app {
    use crate::flash::ParameterFlash;
    use crate::pins::{self, Chips, Ecu405, StartError};
    use crate::target::constant_watch::{CORRUPT, ConstantWatch};
    use crate::{log, safe_state, target};
    use cortex_m::singleton;
    use firmware::board::Controller;
    use firmware::board::start_up::{memory_holds, quiet_code, try_outputs};
    use firmware::can::address::{Addresses, Name};
    use firmware::service::{Done, Errand};
    use firmware::store::Store;
    use firmware::supervisor::Check;
    use firmware::{Fitted, Parameters, SelfTest, TICKS_PER_S};
    use stm32f4xx_hal::pac::TIM2;
    use stm32f4xx_hal::prelude::*;
    use stm32f4xx_hal::timer::{CounterHz, Event, Flag};

    /// A maker sets its own code from SAE and numbers its controllers; 0 is nobody's.
    const NAME: Name = Name { identity: 1, manufacturer: 0, ecu_instance: 0, function_instance: 0 };

    const CYCLES_PER_MS: u32 = 168_000;
    /// Words of memory that the self-test tries: where the stack will grow to.
    const TRIED_WORDS: usize = 1024;

    type Memory = &'static mut Fitted;

    #[shared]
    struct Shared {
        /// From the tick to the idle loop, and back.
        errand: Option<Errand<Memory>>,
        done: Option<Done<Memory>>,
    }

    #[local]
    struct Local {
        board: Ecu405,
        controller: &'static mut Controller<Memory>,
        watch: ConstantWatch,
        timer: CounterHz<TIM2>,
        store: Store<ParameterFlash>,
    }

    #[init(local = [fitted: Fitted = Fitted::new()])]
    fn init(mut cx: init::Context) -> (Shared, Local) {
        target::stack_guard::arm(&mut cx.core.MPU);
        let mut rcc = pins::clocks(cx.device.RCC);
        // Outputs off and cut-off open come before anything that can fail.
        let (gpio, outputs) = pins::outputs_off(
            (cx.device.GPIOA, cx.device.GPIOB, cx.device.GPIOC),
            (cx.device.TIM3, cx.device.TIM4),
            &mut rcc,
        );
        let Ok(mut store) = Store::new(ParameterFlash::new(cx.device.FLASH)) else {
            safe_state::halt(&|| defmt::error!("no store in these sectors"))
        };
        let (parameters, [count, mounted]) = parameters(&mut store);
        let (controller, quiet_code) = (controller(&parameters, cx.local.fitted), quiet_code(&parameters.coils));
        controller.set_buckets(count, mounted);
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
            memory: stack_holds(),
            drivers,
            cut_off,
        });
        let mut timer = cx.device.TIM2.counter_hz(&mut rcc);
        if timer.start(TICKS_PER_S.Hz()).is_err() {
            safe_state::halt(&|| defmt::error!("no such tick rate"));
        }
        timer.listen(Event::Update);
        let watch = ConstantWatch::new();
        (Shared { errand: None, done: None }, Local { board, controller, watch, timer, store })
    }

    /// The stored parameters with the mounted bucket, how many buckets there are and which is mounted; without them nothing ever moves. Not
    /// inlined, nor is [`controller`]: one's values are off the stack before the other's come.
    #[inline(never)]
    fn parameters(store: &mut Store<ParameterFlash>) -> (Parameters, [u8; 2]) {
        let Ok(loaded) = store.load() else { safe_state::halt(&|| defmt::error!("no approved parameters in flash")) };
        let record = &loaded.record;
        let Ok(parameters) = record.parameters_for(record.mounted.into()) else {
            safe_state::halt(&|| defmt::error!("no such bucket"))
        };
        (parameters, [record.bucket_count(), record.mounted])
    }

    #[inline(never)]
    fn stack_holds() -> Check {
        memory_holds(&mut [0; TRIED_WORDS])
    }

    #[inline(never)]
    fn controller(parameters: &Parameters, fitted: Memory) -> &'static mut Controller<Memory> {
        let Ok(controller) = Controller::with(parameters, Addresses::DEFAULT, &NAME, fitted) else {
            safe_state::halt(&|| defmt::error!("the parameters are refused"))
        };
        let placed = singleton!(: Controller<Memory> = controller);
        placed.unwrap_or_else(|| safe_state::halt(&|| defmt::error!("started twice")))
    }

    #[idle(local = [store], shared = [errand, done])]
    fn idle(mut cx: idle::Context) -> ! {
        let mut said = None;
        loop {
            cortex_m::asm::wfi();
            said = log::say_changes(said);
            if let Some(errand) = cx.shared.errand.lock(Option::take) {
                let done = run(errand, cx.local.store);
                cx.shared.done.lock(|back| *back = Some(done));
            }
        }
    }

    /// Interrupted by the ticks, which feed the watchdog; while the flash erases, the code that waits in RAM does. Not inlined: `cargo hil
    /// image` states its stack.
    #[inline(never)]
    fn run(errand: Errand<Memory>, store: &mut Store<ParameterFlash>) -> Done<Memory> {
        errand.run(store)
    }

    #[task(binds = TIM2, local = [board, controller, watch, timer, late: bool = false], shared = [errand, done])]
    fn tick(mut cx: tick::Context) {
        let tick::LocalResources { board, controller, timer, late, .. } = cx.local;
        timer.clear_flags(Flag::Update);
        if let Some(done) = cx.shared.done.lock(Option::take) {
            controller.done(done);
        }
        let inputs = controller.read(board, *late);
        let outputs = control_tick::tick(controller, &inputs);
        controller.write(board, &outputs);
        if let Some(due) = controller.errand(board) {
            cx.shared.errand.lock(|errand| *errand = Some(due));
        }
        // After the errand: what it will write is not watched while it is lent.
        if !cx.local.watch.look(controller.ecu()) {
            controller.self_tested(&CORRUPT);
        }
        log::leave(&outputs);
        // The next period has begun already: this one ended too late, and the next tick says so.
        *late = timer.flags().contains(Flag::Update);
    }
}
