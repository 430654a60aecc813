//! What is stored: the parameters and the buckets they may be used with.

use core::fmt;

use kinematics_core::{PinGeometry, Vec2};
use serde::{Deserialize, Serialize};

use super::fields::{Field, Sink, Source};
use crate::parameters::{ParameterError, Parameters};

/// Buckets a record has room for.
pub const MAX_BUCKETS: usize = 8;

/// A name of 1 to 16 printable ASCII characters, padded with zeros.
#[derive(Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Name([u8; 16]);

impl Name {
    /// From text; `None` when it is empty, too long or not printable ASCII.
    pub fn new(text: &str) -> Option<Self> {
        let mut bytes = [0; 16];
        bytes.get_mut(..text.len())?.copy_from_slice(text.as_bytes());
        let name = Self(bytes);
        name.text().map(|_| name)
    }

    /// Its text; `None` when stored bytes are no name.
    pub fn text(&self) -> Option<&str> {
        let length = self.0.iter().position(|&byte| byte == 0).unwrap_or(self.0.len());
        let (name, padding) = self.0.split_at_checked(length)?;
        let good = !name.is_empty()
            && name.iter().all(|byte| matches!(byte, b' '..=b'~'))
            && padding.iter().all(|&byte| byte == 0);
        if good { core::str::from_utf8(name).ok() } else { None }
    }
}

impl Field for Name {
    fn read(from: &mut Source) -> Self {
        Self(Field::read(from))
    }

    fn write(&self, to: &mut Sink) {
        self.0.write(to);
    }
}

impl fmt::Debug for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}", self.text().unwrap_or("?"))
    }
}

/// One bucket: what of the pin geometry comes and goes with it. Cylinder, rocker and strokes stay the machine's.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Bucket {
    /// Its name.
    pub name: Name,
    /// Bucket pin to tip, a4 (m).
    pub bucket_m: f64,
    /// Coupler pin H in the bucket frame, m.
    pub coupler_pin: Vec2<f64>,
    /// Coupler length c (m).
    pub coupler_m: f64,
}

/// The record. Bucket 0 is there always; no bucket follows an empty place.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StoredRecord {
    /// The machine's name.
    pub machine: Name,
    /// The parameters; of the bucket's geometry the chosen bucket's counts.
    pub parameters: Parameters,
    /// The buckets.
    pub buckets: [Option<Bucket>; MAX_BUCKETS],
    /// The one that is mounted.
    pub mounted: u8,
}

/// What is wrong with a record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RecordError {
    /// The machine's name is none.
    MachineName,
    /// The name of this bucket is none.
    BucketName {
        /// The bucket's index.
        bucket: usize,
    },
    /// There is no bucket of this index, or one stands behind an empty place.
    NoBucket {
        /// The bucket's index.
        bucket: usize,
    },
    /// A parameter is at fault when this bucket is mounted.
    Parameter {
        /// The bucket's index.
        bucket: usize,
        /// Field and range.
        error: ParameterError,
    },
}

impl fmt::Display for RecordError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = "must be 1 to 16 printable ASCII characters";
        match self {
            Self::MachineName => write!(f, "`machine` {name}"),
            Self::BucketName { bucket } => write!(f, "`buckets[{bucket}].name` {name}"),
            Self::NoBucket { bucket } => write!(f, "`buckets[{bucket}]` is empty"),
            Self::Parameter { bucket, error } => write!(f, "with `buckets[{bucket}]`: {error}"),
        }
    }
}

impl core::error::Error for RecordError {}

impl StoredRecord {
    /// The parameters with this bucket mounted, valid.
    ///
    /// # Errors
    /// [`RecordError::NoBucket`], [`RecordError::Parameter`].
    pub fn parameters_for(&self, bucket: usize) -> Result<Parameters, RecordError> {
        let mut parameters = self.parameters;
        parameters.geometry = self.geometry_for(bucket).ok_or(RecordError::NoBucket { bucket })?;
        parameters.validate().map_err(|error| RecordError::Parameter { bucket, error })?;
        Ok(parameters)
    }

    /// The geometry with this bucket mounted; `None` where there is none of this index.
    pub fn geometry_for(&self, bucket: usize) -> Option<PinGeometry> {
        let mounted = self.buckets.get(bucket).copied().flatten()?;
        let mut geometry = self.parameters.geometry;
        geometry.bucket_m = mounted.bucket_m;
        geometry.bucket.coupler_pin = mounted.coupler_pin;
        geometry.bucket.coupler_m = mounted.coupler_m;
        Some(geometry)
    }

    /// How many buckets there are.
    pub fn bucket_count(&self) -> u8 {
        self.buckets.iter().flatten().fold(0, |count, _| count + 1)
    }

    /// Checks the names, that no bucket stands behind an empty place, the mounted one, and the parameters with every bucket.
    ///
    /// # Errors
    /// The first at fault, by name and range.
    pub fn validate(&self) -> Result<(), RecordError> {
        self.machine.text().ok_or(RecordError::MachineName)?;
        let used = self.buckets.iter().rposition(Option::is_some).map_or(1, |last| last + 1);
        for (index, bucket) in self.buckets.iter().enumerate().take(used) {
            self.parameters_for(index)?;
            if bucket.is_some_and(|bucket| bucket.name.text().is_none()) {
                return Err(RecordError::BucketName { bucket: index });
            }
        }
        let mounted = usize::from(self.mounted);
        if mounted < used { Ok(()) } else { Err(RecordError::NoBucket { bucket: mounted }) }
    }
}
