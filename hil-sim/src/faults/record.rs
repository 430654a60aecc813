//! The stored parameter record spoilt before the start.

use firmware::Parameters;
use firmware::board::Disabled;
use firmware::simulated::SimulatedBoard;
use firmware::store::{LoadError, Name, Sealed, Store, StoredRecord};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::RngCore;
use sim_chips::nor_flash::NorFlash;

use crate::machine_file::MachineFile;
use crate::record::buckets::{all, standard};

const SECTOR: usize = 4096;

/// What came of the spoilt record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Came {
    /// The bits had turned back.
    Nothing,
    /// No controller is built.
    Refused,
    /// Another record than was written is loaded.
    Believed,
}

/// Turns one to eight bits in each copy before the controller's start.
pub(super) fn spoilt(machine: &MachineFile, parameters: &Parameters, dice: &mut ChaCha8Rng) -> Result<Came, String> {
    let name = Name::new(&machine.name).ok_or("a machine's name of more than 16 letters")?;
    let record = StoredRecord {
        machine: name,
        parameters: *parameters,
        buckets: all(standard(&parameters.geometry), None).map_err(|error| error.to_string())?,
        mounted: 0,
    };
    let mut sealed = Sealed::new(&record).map_err(|fault| fault.to_string())?;
    sealed.approve();
    let mut board = SimulatedBoard::new().map_err(|error| error.to_string())?;
    let mut store = Store::new(NorFlash::<SECTOR>::new()).map_err(|fit| format!("{fit:?}"))?;
    let permit = Disabled::new(board.parts()).map_err(|error| format!("{error:?}"))?;
    store.write(&permit, &sealed).map_err(|error| error.to_string())?;
    let bytes = sealed.as_bytes().len() as u32;
    for sector in [0, SECTOR] {
        for _ in 0..1 + dice.next_u32() % 8 {
            let place = sector + (dice.next_u32() % bytes) as usize;
            store.flash().flip(place, 1 << (dice.next_u32() % 8));
        }
    }
    match store.load() {
        Err(LoadError::BothBad(_) | LoadError::OnlyOlder(_) | LoadError::NotApproved) => Ok(Came::Refused),
        Err(error) => Err(error.to_string()),
        Ok(loaded) => Ok(if loaded.record == record { Came::Nothing } else { Came::Believed }),
    }
}
