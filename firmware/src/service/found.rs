//! What a calibration found: a proposal for the record, until somebody keeps it.

use kinematics_core::{Rotor, Vec2};

use crate::calibration::end_stops::EndCodes;
use crate::calibration::measure_up::MeasuredBucket;
use crate::calibration::valve_search::FoundValve;
use crate::can::table::service::FOUND_ENDS;
use crate::parameters::{ParameterError, SwingSensor};
use crate::store::{RecordError, StoredRecord};

/// A result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Found {
    /// Of this spool: extend, retract; dead bands are shares of full-scale current.
    Valve(u8, FoundValve),
    /// Of the cylinder on this spool.
    Ends(u8, EndCodes),
    /// Of the mounted bucket.
    Bucket(MeasuredBucket),
}

impl Found {
    /// As on the bus.
    pub(crate) const fn kind(&self) -> u32 {
        match self {
            Self::Valve(..) => 1,
            Self::Ends(..) => 2,
            Self::Bucket(_) => 3,
        }
    }

    /// Values of [`crate::can::table::service::FOUND_VALVE`].
    pub(crate) fn valve(&self) -> Option<[f32; 4]> {
        let Self::Valve(_, [extend, retract]) = self else { return None };
        Some([100.0 * extend.dead_band, extend.full_speed, 100.0 * retract.dead_band, retract.full_speed])
    }

    /// Payload of [`FOUND_ENDS`].
    pub(crate) fn ends_or_tip(&self) -> u64 {
        let [min, max, length, offset] = &FOUND_ENDS.signals;
        match self {
            Self::Valve(..) => u64::MAX,
            Self::Ends(_, ends) => max.put(min.put(u64::MAX, ends.min_code.into()), ends.max_code.into()),
            Self::Bucket(tip) => {
                offset.put(length.put(u64::MAX, length.code(tip.length_m)), offset.code(tip.offset.sin))
            }
        }
    }

    /// The record with these values, valid; `bucket` is the one that was mounted.
    ///
    /// # Errors
    /// [`RecordError::NoBucket`], or the first parameter that the values put out of its range.
    pub fn in_record(&self, record: &StoredRecord, bucket: usize) -> Result<StoredRecord, RecordError> {
        let mut record = *record;
        let p = &mut record.parameters;
        match self {
            Self::Valve(spool, found) => {
                if let Some(spool) = p.coils.spools.get_mut(usize::from(*spool)) {
                    for (flow, found) in spool.flow.iter_mut().zip(found) {
                        flow.min_current_a = found.dead_band * flow.max_current_a;
                        flow.full_speed = found.full_speed;
                    }
                }
            }
            Self::Ends(spool, ends) => {
                let sensor = match (usize::from(*spool).checked_sub(1), &mut p.swing_sensor) {
                    (Some(cylinder), _) => p.cylinder_sensors.get_mut(cylinder),
                    (None, SwingSensor::Cylinder(sensor)) => Some(sensor),
                    (None, SwingSensor::Angle { .. }) => None,
                };
                let error = RecordError::Parameter { bucket, error: ParameterError::NoSwingCylinder };
                let sensor = sensor.ok_or(error)?;
                (sensor.min_code, sensor.max_code) = (ends.min_code, ends.max_code);
            }
            Self::Bucket(measured) => {
                let mounted = record.buckets.get_mut(bucket).and_then(Option::as_mut);
                let mounted = mounted.ok_or(RecordError::NoBucket { bucket })?;
                mounted.bucket_m = measured.length_m.into();
                // The bucket's frame has its x axis through the tip: the coupler pin turns the other way.
                let offset = Rotor { cos: f64::from(measured.offset.cos), sin: f64::from(measured.offset.sin) };
                let Vec2 { x, z } = offset.inverse().rotate(mounted.coupler_pin);
                mounted.coupler_pin = Vec2 { x, z };
            }
        }
        record.validate()?;
        Ok(record)
    }
}
