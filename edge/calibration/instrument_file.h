// Reads and writes instrument.toml: camera, lens and pan-tilt unit as one instrument, with its
// serial numbers, its parameters and their sigmas.
#pragma once

#include <string>

#include "calibration/state.h"
#include "edge/config/config.h"

namespace ols::calibration {

// Constants of the lens model and of the unit. The adjusted values are valid only together with
// these constants, which an adjustment does not change.
struct FixedValues {
  LensModel model = LensModel::kPinhole;
  double skew = 0.0, p1 = 0.0, p2 = 0.0;
  int pan_sign = 1, tilt_sign = 1;
  double pan_zero_rad = 0.0, tilt_zero_rad = 0.0;
};

struct Instrument {
  station::InstrumentSerials serials;
  FixedValues fixed;
  AxisModel pan, tilt;  // number of counts and teeth; the errors are in `values`
  // 1-sigma of each angle at a stop of the unit, independent from stop to stop.
  double angle_sd_rad = 5.0 * EIGEN_PI / 648000.0;
  // Name of a file in the same folder; if empty, instrument.toml gives only sigmas, in [sd].
  std::string covariance_file;
  InstrumentVector values = InstrumentVector::Zero();
  InstrumentMatrix covariance = InstrumentMatrix::Zero();
};

// Makes an instrument for a new unit, from a station's configuration. The sigmas come from
// calibration/parameters.h; those of the mounting are at least as large as in [calibration.sd].
Instrument new_instrument(const station::StationSettings& settings);

// Reads the file. Keys that are missing get the values of `fallback`. Throws ConfigError or
// CsvError, naming file, line and key.
Instrument read_instrument(const std::string& path, const Instrument& fallback);

// Throws std::invalid_argument, naming file and key, if a serial number contains a quote, a
// backslash or a control character, because the file cannot store these.
void check_plain(const station::InstrumentSerials& serials, const std::string& path);

// Throws std::invalid_argument, naming the part, if serial numbers differ.
void check_serials(const station::InstrumentSerials& configured,
                   const station::InstrumentSerials& calibrated, const std::string& path);
// The parts whose serial number is in only one of `configured` and `calibrated`, and therefore
// cannot be compared; empty if there are none.
std::string uncompared_serials(const station::InstrumentSerials& configured,
                               const station::InstrumentSerials& calibrated);

// The model of a station with this instrument.
StationModel with_instrument(const StationGeometry& geometry, const Instrument& instrument);

// The text of instrument.toml.
std::string instrument_text(const Instrument& instrument);

}  // namespace ols::calibration
