//! The application in the emulated Cortex-M4F, in lockstep over two pipes.

use std::io::{Read, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, ExitStatus, Stdio};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

use firmware::Parameters;
use firmware::simulated::Wires;
use firmware::simulated::link::{self, REFUSAL_BYTES, REPLY_BYTES, Request, Spoil, Zone};

use super::one_core::OneCore;
use super::{Image, Place, PlaceError, Reply, Timing};

/// log2 of the virtual nanoseconds an instruction takes; the image's stopwatch counts on it.
const ICOUNT_SHIFT: &str = "shift=3,sleep=off";
/// An emulator that says nothing this long is ended.
const SILENCE: Duration = Duration::from_secs(30);

/// A running emulator.
pub struct Emulator {
    child: Arc<Mutex<Child>>,
    to_image: ChildStdin,
    from_image: ChildStdout,
    guard: Guard,
    _one_core: OneCore,
}

impl Emulator {
    /// Starts an image that speaks first or only prints, without a conversation.
    ///
    /// # Errors
    /// The emulator is not there.
    pub fn start(image: &Image) -> Result<Self, PlaceError> {
        let one_core = OneCore::take();
        let mut child = Command::new("qemu-system-arm")
            .args(["-machine", "netduinoplus2", "-display", "none", "-serial", "none", "-monitor", "none"])
            .args(["-semihosting-config", "enable=on,target=native"])
            .args(["-icount", ICOUNT_SHIFT])
            .arg("-kernel")
            .arg(&image.path)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .map_err(PlaceError::Start)?;
        let pipes = (child.stdin.take(), child.stdout.take());
        let (Some(to_image), Some(from_image)) = pipes else { unreachable!("both were asked for as pipes") };
        let child = Arc::new(Mutex::new(child));
        let guard = Guard::watch(child.clone());
        Ok(Self { child, to_image, from_image, guard, _one_core: one_core })
    }

    /// Starts the controller's image and gives it its parameters.
    ///
    /// # Errors
    /// No emulator, or parameters the application refuses.
    pub fn with_parameters(image: &Image, parameters: &Parameters) -> Result<Self, PlaceError> {
        let mut emulator = Self::start(image)?;
        let record = postcard::to_stdvec(parameters).map_err(|e| PlaceError::Parameters(e.to_string()))?;
        emulator.write(&(record.len() as u32).to_le_bytes())?;
        emulator.write(&record)?;
        let mut length = [0; 4];
        emulator.read(&mut length)?;
        let length = u32::from_le_bytes(length);
        // An image that is no controller says anything; it is not believed to have gigabytes to say.
        let length = usize::try_from(length).ok().filter(|&length| length <= REFUSAL_BYTES);
        let Some(length) = length else {
            return Err(emulator.lost("its first word is no length of a text".to_owned()));
        };
        let mut refusal = vec![0; length];
        emulator.read(&mut refusal)?;
        if refusal.is_empty() {
            Ok(emulator)
        } else {
            Err(PlaceError::Parameters(String::from_utf8_lossy(&refusal).into_owned()))
        }
    }

    /// Everything the image prints until it ends.
    ///
    /// # Errors
    /// The image failed.
    pub fn printed(mut self) -> Result<String, PlaceError> {
        let mut text = String::new();
        let read = self.from_image.read_to_string(&mut text);
        match (read, self.ended()) {
            (Ok(_), Some(status)) if status.success() => Ok(text),
            (_, status) => Err(self.lost(format!("{status:?} after {text:?}"))),
        }
    }

    /// Ends the run; gives the deepest use of the stack, bytes, or of `spoilt-emulated` the most instructions of its watch in a tick.
    ///
    /// # Errors
    /// The emulator was lost.
    pub fn finish(mut self) -> Result<u32, PlaceError> {
        self.write(&Request::End.to_bytes())?;
        let mut stack = [0; 4];
        self.read(&mut stack)?;
        match self.ended() {
            Some(status) if status.success() => Ok(u32::from_le_bytes(stack)),
            other => Err(self.lost(format!("it ended with {other:?}"))),
        }
    }

    /// Breaks something in the image before its next tick, and says where it was; only the image `spoilt-emulated` can.
    ///
    /// # Errors
    /// The emulator was lost.
    pub fn spoil(&mut self, spoil: Spoil) -> Result<Zone, PlaceError> {
        self.write(&Request::Spoil(spoil).to_bytes())?;
        let mut code = [0; 4];
        self.read(&mut code)?;
        let code = u32::from_le_bytes(code);
        Zone::from_code(code).ok_or_else(|| self.lost(format!("{code} is no zone of its memory")))
    }

    /// A tick, its reply as the bytes that came.
    ///
    /// # Errors
    /// The emulator was lost.
    pub fn exchange(&mut self, wires: &Wires) -> Result<[u8; REPLY_BYTES], PlaceError> {
        self.guard.alive();
        self.write(&Request::Tick(*wires).to_bytes())?;
        let mut reply = [0; REPLY_BYTES];
        self.read(&mut reply)?;
        Ok(reply)
    }

    /// How the emulator ended, when it has: its exit code, or 134 when it aborted, which it does when the core locks up.
    pub fn exit_code(&self) -> Option<i32> {
        const ABORTED: i32 = 134;
        self.ended().map(|status| status.code().unwrap_or(ABORTED))
    }

    fn child(&self) -> MutexGuard<'_, Child> {
        self.child.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The status of an emulator that is about to end; `None` if it does not within a few seconds.
    fn ended(&self) -> Option<ExitStatus> {
        let pause = Duration::from_millis(5);
        (0..1000).find_map(|_| {
            let status = self.child().try_wait().ok().flatten();
            if status.is_none() {
                thread::sleep(pause);
            }
            status
        })
    }

    fn write(&mut self, bytes: &[u8]) -> Result<(), PlaceError> {
        self.to_image.write_all(bytes).map_err(|e| self.lost(e.to_string()))
    }

    fn read(&mut self, buffer: &mut [u8]) -> Result<(), PlaceError> {
        self.from_image.read_exact(buffer).map_err(|e| self.lost(e.to_string()))
    }

    fn lost(&mut self, why: String) -> PlaceError {
        let why = match self.child().try_wait() {
            Ok(Some(status)) => format!("qemu-system-arm ended with {status} ({why})"),
            _ => why,
        };
        let why = if self.guard.fired() { format!("it said nothing for {SILENCE:?}") } else { why };
        // A child already gone cannot be ended again; either way its standard error is complete now.
        let _ = self.child().kill();
        let mut said = String::new();
        let stderr = self.child().stderr.take();
        if let Some(mut stderr) = stderr {
            let _ = stderr.read_to_string(&mut said);
        }
        let said = if said.is_empty() { said } else { format!("\nit printed: {}", said.trim_end()) };
        PlaceError::Lost { why, said }
    }
}

impl Place for Emulator {
    fn tick(&mut self, wires: &Wires) -> Result<Reply, PlaceError> {
        let reply = self.exchange(wires)?;
        let link::Reply { outputs, pins, started_ns, instructions } = link::Reply::from_bytes(&reply)?;
        let timing = Timing::Emulator { started_ns, instructions };
        Ok(Reply { outputs, pins, timing })
    }
}

impl Drop for Emulator {
    fn drop(&mut self) {
        // After `finish` the child is gone already and there is nothing to end.
        let mut child = self.child();
        let _ = child.kill();
        let _ = child.wait();
    }
}

/// Ends an emulator that has gone silent, so that a read from it cannot hang.
struct Guard {
    exchanges: Arc<AtomicU64>,
    over: Arc<AtomicBool>,
    fired: Arc<AtomicBool>,
}

impl Guard {
    fn watch(child: Arc<Mutex<Child>>) -> Self {
        let exchanges = Arc::new(AtomicU64::new(0));
        let over = Arc::new(AtomicBool::new(false));
        let fired = Arc::new(AtomicBool::new(false));
        let guard = Self { exchanges: exchanges.clone(), over: over.clone(), fired: fired.clone() };
        thread::spawn(move || {
            let mut seen = 0;
            let mut silent = Duration::ZERO;
            let step = Duration::from_millis(500);
            while !over.load(Ordering::Relaxed) {
                thread::sleep(step);
                let now = exchanges.load(Ordering::Relaxed);
                silent = if now == seen { silent + step } else { Duration::ZERO };
                seen = now;
                if silent >= SILENCE {
                    fired.store(true, Ordering::Relaxed);
                    let _ = child.lock().unwrap_or_else(PoisonError::into_inner).kill();
                    return;
                }
            }
        });
        guard
    }

    fn alive(&self) {
        self.exchanges.fetch_add(1, Ordering::Relaxed);
    }

    fn fired(&self) -> bool {
        self.fired.load(Ordering::Relaxed)
    }
}

impl Drop for Guard {
    fn drop(&mut self) {
        self.over.store(true, Ordering::Relaxed);
    }
}
