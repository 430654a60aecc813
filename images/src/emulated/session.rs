//! The controller on simulated chips, in conversation with the harness.

use firmware::board::Controller;
use firmware::can::address::Addresses;
use firmware::simulated::link::{NAME, RECORD_BYTES, REFUSAL_BYTES, REQUEST_BYTES, Reply, Request};
use firmware::simulated::{SimulatedBoard, Wires};
use firmware::store::parameters_from;
use firmware::{Fitted, SelfTest};

use crate::emulated::link::{Link, LinkLost};
use crate::emulated::stopwatch::Stopwatch;

/// Everything a tick needs.
pub(crate) struct Session {
    pub(crate) link: Link,
    pub(crate) controller: Controller<&'static mut Fitted>,
    pub(crate) stopwatch: Stopwatch,
    board: SimulatedBoard,
    /// Address and size of what is fitted to the bucket.
    #[allow(dead_code)] // as below
    fitted: [usize; 2],
}

impl Session {
    /// Where the controller's memory lies beside itself, and how many bytes.
    #[allow(dead_code)] // only the image that is spoilt asks
    pub(crate) fn fitted_at(&self) -> (*mut u8, usize) {
        let [address, bytes] = self.fitted;
        (core::ptr::with_exposed_provenance_mut(address), bytes)
    }

    /// Takes the parameter record and answers with the error's text, empty when the application was built.
    pub(crate) fn open(stopwatch: Stopwatch, fitted: &'static mut Fitted) -> Result<Self, LinkLost> {
        let at = [core::ptr::from_mut(fitted).expose_provenance(), size_of::<Fitted>()];
        let mut link = Link::open()?;
        let mut length = [0; 4];
        link.read(&mut length)?;
        let mut record = [0; RECORD_BYTES];
        let record = record.get_mut(..u32::from_le_bytes(length) as usize).ok_or(LinkLost)?;
        link.read(record)?;
        let mut text = Text::default();
        let built = match parameters_from(record) {
            Some(parameters) => Controller::with(&parameters, Addresses::DEFAULT, &NAME, fitted)
                .map(|mut controller| {
                    // The emulated board has none of the parts that the self-test tries.
                    controller.self_tested(&SelfTest::PASSED);
                    controller
                })
                .map_err(|error| text.set(&error)),
            None => {
                text.set(&"the bytes are no parameters");
                Err(())
            }
        };
        link.write(&(text.as_bytes().len() as u32).to_le_bytes())?;
        link.write(text.as_bytes())?;
        let controller = built.map_err(|()| LinkLost)?;
        let board = SimulatedBoard::new().map_err(|_| LinkLost)?;
        Ok(Self { link, controller, stopwatch, board, fitted: at })
    }

    /// What the harness asks for next.
    pub(crate) fn request(&mut self) -> Result<Request, LinkLost> {
        let mut message = [0; REQUEST_BYTES];
        self.link.read(&mut message)?;
        Request::from_bytes(&message).map_err(|_| LinkLost)
    }

    /// One tick, and its reply; whether the watchdog was fed.
    pub(crate) fn tick(&mut self, wires: &Wires, started_ns: u32) -> Result<bool, LinkLost> {
        let Self { link, board, controller, stopwatch, .. } = self;
        board.connect(wires);
        let inputs = controller.read(board.parts(), wires.overrun);
        let before = stopwatch.now_ns();
        let outputs = control_tick::tick(controller, &inputs);
        let after = stopwatch.now_ns();
        controller.write(board.parts(), &outputs);

        let instructions = stopwatch.instructions(before, after);
        let reply = Reply { outputs, pins: board.pins(), started_ns, instructions };
        link.write(&reply.to_bytes())?;
        Ok(reply.pins.watchdog_fed)
    }
}

/// An error's text in a fixed buffer; what does not fit is cut.
struct Text {
    bytes: [u8; REFUSAL_BYTES],
    length: usize,
}

impl Default for Text {
    fn default() -> Self {
        Self { bytes: [0; REFUSAL_BYTES], length: 0 }
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
