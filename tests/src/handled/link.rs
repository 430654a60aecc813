//! What the emulated image and the harness say to each other: each end is given any bytes.

use firmware::board::Controller;
use firmware::can::address::Addresses;
use firmware::simulated::SimulatedBoard;
use firmware::simulated::link::{NAME, REPLY_BYTES, REQUEST_BYTES, Reply, Request};
use firmware::{Parameters, SelfTest};

use super::record::accepted;
use super::{Cursor, sound};
use crate::rig::scenario;

/// Requests answered in a row.
const REQUESTS: usize = 12;

/// The first byte says who listens: the image to requests or to a parameter record, or the harness to a reply.
pub fn exchange(bytes: &[u8]) {
    let mut cursor = Cursor(bytes);
    match cursor.byte() % 3 {
        0 => image(&mut cursor),
        1 => parameters(cursor.0),
        _ => harness(&mut cursor),
    }
}

/// The controller, and bytes for its connectors.
fn image(cursor: &mut Cursor<'_>) {
    thread_local! {
        static CONTROLLER: Controller = {
            let built = Controller::new(&scenario("fence-zx200").parameters, Addresses::DEFAULT, &NAME);
            let mut controller = built.expect("good parameters");
            controller.self_tested(&SelfTest::PASSED);
            controller
        };
    }
    let (mut controller, mut board) = (CONTROLLER.with(Clone::clone), SimulatedBoard::new().expect("good chips"));
    for _ in 0..REQUESTS {
        if cursor.is_empty() {
            return;
        }
        let bytes = cursor.take::<REQUEST_BYTES>();
        let wires = match Request::from_bytes(&bytes) {
            Err(error) => return assert!(error.to_string().contains(error.field)),
            Ok(Request::End) => return,
            Ok(spoil @ Request::Spoil(_)) => return assert_eq!(Request::from_bytes(&spoil.to_bytes()), Ok(spoil)),
            Ok(Request::Tick(wires)) => wires,
        };
        // A length that no frame has, and what stands behind it, may be said in several ways; said once more it stays.
        let said = Request::Tick(wires).to_bytes();
        assert_eq!(Request::from_bytes(&said).map(|request| request.to_bytes()), Ok(said));
        board.connect(&wires);
        let outputs = controller.cycle(board.parts(), wires.overrun);
        sound(&outputs);
        let reply = Reply { outputs, pins: board.pins(), started_ns: 7, instructions: 9 };
        assert_eq!(Reply::from_bytes(&reply.to_bytes()), Ok(reply));
    }
}

/// The image, and bytes for its parameters.
fn parameters(bytes: &[u8]) {
    if let Ok(parameters) = postcard::from_bytes::<Parameters>(bytes) {
        match parameters.validate() {
            Ok(()) => accepted(&parameters),
            Err(error) => assert!(error.to_string().contains('`'), "{error}"),
        }
    }
}

/// The harness, and bytes for a reply.
fn harness(cursor: &mut Cursor<'_>) {
    match Reply::from_bytes(&cursor.take::<REPLY_BYTES>()) {
        Err(error) => assert!(error.to_string().contains('`'), "{error}"),
        Ok(reply) => {
            let said = reply.to_bytes();
            assert_eq!(Reply::from_bytes(&said).map(|reply| reply.to_bytes()), Ok(said));
        }
    }
}
