//! A record as bytes.
//!
//! ```text
//! 0  magic "XCPR"          16  CRC-32 of the data
//! 4  format version        20  approval: CRC-32C of version, length and data; FFFFFFFFh while nobody signed it off
//! 8  sequence number       24  FFFFFFFFh, reserved
//! 12 length of the data    28  CRC-32 of the 28 bytes before
//! 32 the data: StoredRecord as postcard writes it, see `fields` and `layout`
//! ```
//! All words little-endian. The header's own CRC is programmed last: until it is there, there is no copy.

use core::fmt;

use crc::{CRC_32_ISCSI, CRC_32_ISO_HDLC, Crc, NoTable};

use super::fields::{Field, Sink, Source};
use super::record::{RecordError, StoredRecord};
use crate::parameters::Parameters;

/// Bytes of the header: a multiple of what any flash in question programs at once.
pub const HEADER_BYTES: usize = 32;
/// Room for the data, bytes.
pub const DATA_BYTES: usize = 2048;
/// A whole copy, bytes.
pub const COPY_BYTES: usize = HEADER_BYTES + DATA_BYTES;
/// Version of the record's format; another one is not read.
pub const FORMAT_VERSION: u32 = 3;

const MAGIC: [u8; 4] = *b"XCPR";
const ERASED: u32 = u32::MAX;

// Bit by bit: two tables would take 2 KiB of flash to save a few milliseconds of start-up.
const CRC: Crc<u32, NoTable> = Crc::<u32, NoTable>::new(&CRC_32_ISO_HDLC);
/// Another polynomial, so that no slip can put a data CRC where an approval belongs.
const APPROVAL: Crc<u32, NoTable> = Crc::<u32, NoTable>::new(&CRC_32_ISCSI);

/// Why bytes are no record to work with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CopyFault {
    /// Erased flash.
    Empty,
    /// No header: wrong magic, or its CRC does not fit: never finished, or decayed.
    Header,
    /// The header is whole but of another format.
    Version {
        /// Its version.
        found: u32,
    },
    /// The length is beyond the room, or beyond the bytes given.
    Length {
        /// Its length, bytes.
        found: u32,
    },
    /// The data do not fit their CRC.
    Data,
    /// The data fit their CRC but are no record.
    Malformed,
    /// A value is out of its range.
    Record(RecordError),
}

impl fmt::Display for CopyFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => f.write_str("empty"),
            Self::Header => f.write_str("no intact header"),
            Self::Version { found } => write!(f, "format version {found}, this firmware reads {FORMAT_VERSION}"),
            Self::Length { found } => write!(f, "{found} bytes of data do not fit"),
            Self::Data => f.write_str("the data do not fit their CRC"),
            Self::Malformed => f.write_str("the data are no record"),
            Self::Record(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for CopyFault {}

/// A record read from bytes, valid; whether it may be used is for its approval to say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Decoded {
    /// The record.
    pub record: StoredRecord,
    /// Counts up with every write.
    pub sequence: u32,
    /// Somebody signed these very data off.
    pub approved: bool,
}

/// A valid record with its header: what is programmed, and what the file of `cargo hil params` holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sealed {
    bytes: [u8; COPY_BYTES],
    length: usize,
}

impl Sealed {
    /// Of a valid record, not approved.
    ///
    /// # Errors
    /// [`CopyFault::Record`]; [`CopyFault::Length`] when it does not fit.
    pub fn new(record: &StoredRecord) -> Result<Self, CopyFault> {
        record.validate().map_err(CopyFault::Record)?;
        let mut bytes = [0xff; COPY_BYTES];
        let full = CopyFault::Length { found: DATA_BYTES as u32 };
        let room = bytes.get_mut(HEADER_BYTES..).ok_or(full)?;
        let mut data = Sink::new(room);
        record.write(&mut data);
        let length = data.length().ok_or(full)?;
        let mut copy = Self { bytes, length };
        copy.write_header(0, false);
        Ok(copy)
    }

    /// From bytes, checked as [`decode`] does.
    ///
    /// # Errors
    /// As [`decode`].
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, CopyFault> {
        decode(bytes)?;
        let header = Header::read(bytes)?;
        let mut copy = Self { bytes: [0xff; COPY_BYTES], length: header.length as usize };
        let end = HEADER_BYTES + copy.length;
        if let (Some(to), Some(from)) = (copy.bytes.get_mut(..end), bytes.get(..end)) {
            to.copy_from_slice(from);
        }
        Ok(copy)
    }

    /// Signs it off.
    pub fn approve(&mut self) {
        self.write_header(self.sequence(), true);
    }

    /// The same record with another sequence number; an approval stays.
    pub(super) fn with_sequence(mut self, sequence: u32) -> Self {
        let approved = self.is_approved();
        self.write_header(sequence, approved);
        self
    }

    /// Whether somebody signed it off.
    pub fn is_approved(&self) -> bool {
        Header::read(&self.bytes).is_ok_and(|header| header.approves(self.data()))
    }

    fn sequence(&self) -> u32 {
        Header::read(&self.bytes).map_or(0, |header| header.sequence)
    }

    /// Header and data.
    pub fn as_bytes(&self) -> &[u8] {
        self.bytes.get(..HEADER_BYTES + self.length).unwrap_or(&[])
    }

    /// The header, and the data with erased bytes up to a multiple of [`HEADER_BYTES`].
    pub(super) fn parts(&self) -> (&[u8], &[u8]) {
        let whole = HEADER_BYTES + self.length.next_multiple_of(HEADER_BYTES);
        self.bytes.get(..whole).and_then(|bytes| bytes.split_at_checked(HEADER_BYTES)).unwrap_or((&[], &[]))
    }

    fn data(&self) -> &[u8] {
        self.as_bytes().get(HEADER_BYTES..).unwrap_or(&[])
    }

    #[inline(never)]
    fn write_header(&mut self, sequence: u32, approved: bool) {
        let length = self.length as u32;
        let data_crc = CRC.checksum(self.data());
        let approval = if approved { approval(length, self.data()) } else { ERASED };
        let words = [u32::from_le_bytes(MAGIC), FORMAT_VERSION, sequence, length, data_crc, approval, ERASED];
        let mut digest = CRC.digest();
        words.iter().for_each(|word| digest.update(&word.to_le_bytes()));
        let crc = digest.finalize();
        for (place, word) in self.bytes.chunks_exact_mut(4).zip(words.iter().chain([&crc])) {
            place.copy_from_slice(&word.to_le_bytes());
        }
    }
}

#[inline(never)]
fn approval(length: u32, data: &[u8]) -> u32 {
    let mut digest = APPROVAL.digest();
    digest.update(&FORMAT_VERSION.to_le_bytes());
    digest.update(&length.to_le_bytes());
    digest.update(data);
    digest.finalize()
}

/// An intact header.
#[derive(Clone, Copy, Debug)]
pub(super) struct Header {
    version: u32,
    pub(super) sequence: u32,
    length: u32,
    data_crc: u32,
    approval: u32,
}

impl Header {
    pub(super) fn read(bytes: &[u8]) -> Result<Self, CopyFault> {
        let header = bytes.get(..HEADER_BYTES).ok_or(CopyFault::Header)?;
        if header.iter().all(|&byte| byte == 0xff) {
            return Err(CopyFault::Empty);
        }
        let mut words = [0; HEADER_BYTES / 4];
        for (word, bytes) in words.iter_mut().zip(header.as_chunks().0) {
            *word = u32::from_le_bytes(*bytes);
        }
        let [magic, version, sequence, length, data_crc, approval, _, header_crc] = words;
        let covered = header.get(..HEADER_BYTES - 4).unwrap_or(&[]);
        if magic != u32::from_le_bytes(MAGIC) || CRC.checksum(covered) != header_crc {
            return Err(CopyFault::Header);
        }
        Ok(Self { version, sequence, length, data_crc, approval })
    }

    fn approves(&self, data: &[u8]) -> bool {
        // Data whose approval happened to equal erased flash can never be approved: it fails to the safe side.
        self.approval != ERASED && self.approval == approval(self.length, data)
    }
}

/// Reads a record from bytes that begin with its header.
///
/// # Errors
/// The first check that fails, in the order of [`CopyFault`].
pub fn decode(bytes: &[u8]) -> Result<Decoded, CopyFault> {
    let header = Header::read(bytes)?;
    if header.version != FORMAT_VERSION {
        return Err(CopyFault::Version { found: header.version });
    }
    let too_long = CopyFault::Length { found: header.length };
    let length = usize::try_from(header.length).ok().filter(|&length| length <= DATA_BYTES).ok_or(too_long)?;
    let data = bytes.get(HEADER_BYTES..HEADER_BYTES + length).ok_or(too_long)?;
    if CRC.checksum(data) != header.data_crc {
        return Err(CopyFault::Data);
    }
    let mut source = Source::new(data);
    let record = StoredRecord::read(&mut source);
    if source.rest() != Some(&[]) {
        return Err(CopyFault::Malformed);
    }
    record.validate().map_err(CopyFault::Record)?;
    Ok(Decoded { record, sequence: header.sequence, approved: header.approves(data) })
}

/// Parameters alone, written as in the record's data, whatever follows them; not validated. `None` when they are none.
pub fn parameters_from(bytes: &[u8]) -> Option<Parameters> {
    let mut source = Source::new(bytes);
    let parameters = Parameters::read(&mut source);
    source.rest().map(|_| parameters)
}
