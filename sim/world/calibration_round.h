// The observations for a station's calibration in the simulated world: frames of stars, and
// surveyed landmarks, one of which has moved. The texts have the format of the input files of
// `ols-calibrate adjust`.
#pragma once

#include <string>

#include "sim/world/world.h"

namespace ols::sim {

struct CalibrationRound {
  std::string observations;  // JSON, one object per line
  std::string references;    // CSV
};

// Air pressure, air temperature and UT1 - UTC at that time; `ols-calibrate adjust` gets the same
// values.
inline constexpr double kRoundPressure_hPa = 980.0, kRoundTemperature_degC = 10.0;
inline constexpr double kRoundUt1MinusUtc_s = 0.03;

// The observations of one station, with its true unit and pose in this world; deterministic.
CalibrationRound calibration_round(const World& world, std::size_t station);

}  // namespace ols::sim
