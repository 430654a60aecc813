//! One task on a hardware timer: wires in, the drivers on their simulated chips, the tick, pins out.

#[rtic::app(device = stm32f4::stm32f405, peripherals = true)]
mod app {
    use crate::emulated::link::{Link, LinkLost};
    use crate::emulated::stopwatch::Stopwatch;
    use crate::emulated::{fail, stack, succeed};
    use firmware::board::Controller;
    use firmware::can::address::Addresses;
    use firmware::frame::OUTPUT_BYTES;
    use firmware::simulated::link::{KIND_END, NAME, RECORD_BYTES, REPLY_BYTES};
    use firmware::simulated::{PIN_BYTES, SimulatedBoard, WIRE_BYTES, Wires};
    use firmware::{Followers, Parameters, SelfTest};
    use stm32f4::stm32f405::TIM2;

    /// The emulator clocks TIM2 at 1 GHz, and starts over after as many counts as the register says (the chip: one more).
    const PERIOD_COUNTS: u32 = 1_000_000;

    #[shared]
    struct Shared {}

    #[local]
    struct Local {
        link: Link,
        board: SimulatedBoard,
        controller: Controller<&'static mut Followers>,
        stopwatch: Stopwatch,
        timer: TIM2,
    }

    #[init(local = [followers: Followers = Followers::new()])]
    fn init(cx: init::Context) -> (Shared, Local) {
        let stopwatch = Stopwatch::start(cx.device.TIM5);
        let Ok((link, controller)) = connect(cx.local.followers) else { fail() };
        let Ok(board) = SimulatedBoard::new() else { fail() };
        let timer = cx.device.TIM2;
        timer.arr().write(|w| w.arr().set(PERIOD_COUNTS));
        timer.dier().write(|w| w.uie().enabled());
        timer.cr1().write(|w| w.cen().enabled());
        (Shared {}, Local { link, board, controller, stopwatch, timer })
    }

    /// Takes the parameter record and answers with the error's text, empty when the application was built.
    fn connect(followers: &'static mut Followers) -> Result<(Link, Controller<&'static mut Followers>), LinkLost> {
        let mut link = Link::open()?;
        let mut length = [0; 4];
        link.read(&mut length)?;
        let mut record = [0; RECORD_BYTES];
        let record = record.get_mut(..u32::from_le_bytes(length) as usize).ok_or(LinkLost)?;
        link.read(record)?;
        let mut text = Text::default();
        let built = match postcard::from_bytes::<Parameters>(record) {
            Ok(parameters) => Controller::with(&parameters, Addresses::DEFAULT, &NAME, followers)
                .map(|mut controller| {
                    // The emulated board has none of the parts that the self-test tries.
                    controller.self_tested(&SelfTest::PASSED);
                    controller
                })
                .map_err(|error| text.set(&error)),
            Err(error) => {
                text.set(&error);
                Err(())
            }
        };
        link.write(&(text.as_bytes().len() as u32).to_le_bytes())?;
        link.write(text.as_bytes())?;
        built.map(|controller| (link, controller)).map_err(|()| LinkLost)
    }

    #[idle]
    fn idle(_: idle::Context) -> ! {
        loop {
            cortex_m::asm::wfi();
        }
    }

    #[task(binds = TIM2, local = [link, board, controller, stopwatch, timer])]
    fn tick(cx: tick::Context) {
        let tick::LocalResources { link, board, controller, stopwatch, timer, .. } = cx.local;
        let started_ns = stopwatch.now_ns();
        timer.sr().modify(|_, w| w.uif().clear());
        if exchange(link, board, controller, stopwatch, started_ns).is_err() {
            fail();
        }
    }

    /// One exchange with the harness.
    fn exchange(
        link: &mut Link,
        board: &mut SimulatedBoard,
        controller: &mut Controller<&'static mut Followers>,
        stopwatch: &Stopwatch,
        started_ns: u32,
    ) -> Result<(), LinkLost> {
        let mut message = [0; 1 + WIRE_BYTES];
        link.read(&mut message)?;
        let [kind, wires @ ..] = message;
        if kind == KIND_END {
            link.write(&stack::peak_bytes().to_le_bytes())?;
            succeed();
        }
        let wires = Wires::from_bytes(&wires).map_err(|_| LinkLost)?;

        board.connect(&wires);
        let inputs = controller.read(board.parts(), wires.overrun);
        let before = stopwatch.now_ns();
        let outputs = control_tick::tick(controller, &inputs);
        let after = stopwatch.now_ns();
        controller.write(board.parts(), &outputs);

        let mut reply = [0; REPLY_BYTES];
        let (frame, rest) = reply.split_at_mut(OUTPUT_BYTES);
        frame.copy_from_slice(&outputs.to_bytes());
        let (pins, measured) = rest.split_at_mut(PIN_BYTES);
        pins.copy_from_slice(&board.pins().to_bytes());
        let (started, instructions) = measured.split_at_mut(4);
        started.copy_from_slice(&started_ns.to_le_bytes());
        instructions.copy_from_slice(&stopwatch.instructions(before, after).to_le_bytes());
        link.write(&reply)
    }

    /// An error's text in a fixed buffer; what does not fit is cut.
    struct Text {
        bytes: [u8; 256],
        length: usize,
    }

    impl Default for Text {
        fn default() -> Self {
            Self { bytes: [0; 256], length: 0 }
        }
    }

    impl Text {
        fn set(&mut self, error: &dyn core::fmt::Display) {
            let _ = core::fmt::write(self, format_args!("{error}"));
        }

        fn as_bytes(&self) -> &[u8] {
            self.bytes.get(..self.length).unwrap_or(&[])
        }
    }

    impl core::fmt::Write for Text {
        fn write_str(&mut self, text: &str) -> core::fmt::Result {
            for byte in text.bytes() {
                if let Some(slot) = self.bytes.get_mut(self.length) {
                    *slot = byte;
                    self.length += 1;
                }
            }
            Ok(())
        }
    }
}
