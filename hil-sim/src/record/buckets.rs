//! The machine's own bucket, and more from a file of `[[bucket]]` tables.

use std::path::Path;

use firmware::store::{Bucket, MAX_BUCKETS, Name};
use kinematics_core::{PinGeometry, Vec2};
use serde::Deserialize;

use super::RecordFileError;
use crate::toml_text::strictly;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct BucketFile {
    bucket: Vec<Table>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    name: String,
    bucket_m: f64,
    coupler_pin_x_m: f64,
    coupler_pin_z_m: f64,
    coupler_m: f64,
}

/// The bucket the machine file has.
pub(crate) fn standard(geometry: &PinGeometry) -> Option<Bucket> {
    let pins = &geometry.bucket;
    let name = Name::new("standard")?;
    Some(Bucket { name, bucket_m: geometry.bucket_m, coupler_pin: pins.coupler_pin, coupler_m: pins.coupler_m })
}

/// The machine's own first, then the file's.
pub(crate) fn all(own: Option<Bucket>, file: Option<&Path>) -> Result<[Option<Bucket>; MAX_BUCKETS], RecordFileError> {
    let mut buckets = [None; MAX_BUCKETS];
    buckets[0] = own;
    let Some(file) = file else { return Ok(buckets) };
    let text = std::fs::read_to_string(file).map_err(|source| RecordFileError::File {
        verb: "read",
        file: file.into(),
        source,
    })?;
    let invalid = |what: String| RecordFileError::Record { file: file.into(), what };
    let tables: BucketFile = strictly(&text, &[]).map_err(|fault| invalid(fault.to_string()))?;
    let count = tables.bucket.len();
    if count > MAX_BUCKETS - 1 {
        return Err(invalid(format!(
            "`bucket`: {count} tables but at most {}, the machine's own is the first",
            MAX_BUCKETS - 1
        )));
    }
    for (index, (place, table)) in buckets.iter_mut().skip(1).zip(tables.bucket).enumerate() {
        let name = Name::new(&table.name).ok_or_else(|| {
            invalid(format!(
                "`bucket[{index}].name` is {:?} but must be 1 to 16 printable ASCII characters",
                table.name
            ))
        })?;
        let coupler_pin = Vec2 { x: table.coupler_pin_x_m, z: table.coupler_pin_z_m };
        *place = Some(Bucket { name, bucket_m: table.bucket_m, coupler_pin, coupler_m: table.coupler_m });
    }
    Ok(buckets)
}
