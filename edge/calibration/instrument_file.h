// instrument.toml: camera, lens and pan-tilt unit as one thing with its serial numbers, and how
// well each of its parameters is known.
#pragma once

#include <string>

#include "calibration/state.h"
#include "edge/config.h"

namespace ols::calibration {

// Constants of the lens model and of the unit under which the values were found; no adjustment
// changes them.
struct FixedValues {
  double skew = 0.0, p1 = 0.0, p2 = 0.0, k3 = 0.0;
  int pan_sign = 1, tilt_sign = 1;
  double pan_zero_rad = 0.0, tilt_zero_rad = 0.0;
};

struct Instrument {
  station::InstrumentSerials serials;
  FixedValues fixed;
  AxisModel pan, tilt;  // their counts and teeth; the errors are among the values
  double angle_sd_rad = 5.0 * EIGEN_PI / 648000.0;  // of each angle of a pose, new with every pose
  std::string covariance_file;                      // beside this file; empty: [sd] is all there is
  InstrumentVector values = InstrumentVector::Zero();
  InstrumentMatrix covariance = InstrumentMatrix::Zero();
};

// As a station's configuration describes it: a new unit, with the deviations of
// calibration/parameters.h, those of the mounting at least as large as [calibration.sd] has them.
Instrument new_instrument(const station::StationSettings& settings);

// Keys that are missing stay as in `fallback`. ConfigError or CsvError, naming file, line and key.
Instrument read_instrument(const std::string& path, const Instrument& fallback);

// Of a configuration or an instrument: std::invalid_argument, naming file and key, for a serial
// number with a quote, a backslash or a control character, which no file could give back.
void check_plain(const station::InstrumentSerials& serials, const std::string& path);

// Throws std::invalid_argument, naming the part, for serial numbers that differ.
void check_serials(const station::InstrumentSerials& configured,
                   const station::InstrumentSerials& calibrated, const std::string& path);
// Which parts state a serial number on one side only, and so were not compared; empty: none.
std::string uncompared_serials(const station::InstrumentSerials& configured,
                               const station::InstrumentSerials& calibrated);

// The station's model with the instrument in it.
StationModel with_instrument(const StationGeometry& geometry, const Instrument& instrument);

std::string instrument_text(const Instrument& instrument);

}  // namespace ols::calibration
