// A station's parameters in an adjustment: those of geometry/station_model.h, and two for
// refraction.
#pragma once

#include <Eigen/Core>
#include <array>

#include "geometry/station_model.h"

namespace ols::calibration {

inline constexpr int kRefraction = kModelParameters;  // coefficient k of the terrestrial refraction
inline constexpr int kAir = kRefraction + 1;  // factor applied to the astronomical refraction
inline constexpr int kStationParameters = kAir + 1;

using StationVector = Eigen::Matrix<double, kStationParameters, 1>;
using StationMatrix = Eigen::Matrix<double, kStationParameters, kStationParameters>;
using InstrumentVector = Eigen::Matrix<double, kInstrumentParameters, 1>;
using InstrumentMatrix = Eigen::Matrix<double, kInstrumentParameters, kInstrumentParameters>;

struct ParameterText {
  const char* key;       // its name in files, with the unit, for example "mount_z_deg"
  bool is_angle;         // an angle: degrees in files, radians in the program
  double new_unit_sd;    // 1-sigma for a unit that was never calibrated; for kFocal: of fx
  const char* sentence;  // the parameter's meaning
};
// The texts in the order of Parameter.
const std::array<ParameterText, kStationParameters>& parameter_texts();

// Convert from the file's unit to the internal unit, and back.
double from_file(int parameter, double value);
double to_file(int parameter, double value);

// The instrument's parameters of a model.
InstrumentVector instrument_of(const StationModel& model);

}  // namespace ols::calibration
