// What a person and a station observe to calibrate it, in the simulated world: frames of stars and
// surveyed landmarks, one of which has moved. Written as the files of `ols-calibrate adjust`.
#pragma once

#include <string>

#include "sim/world.h"

namespace ols::sim {

struct CalibrationRound {
  std::string observations;  // JSON, one object a line
  std::string references;    // CSV
};

// Of the air and the earth at that time; `ols-calibrate adjust` is told these.
inline constexpr double kRoundPressure_hPa = 980.0, kRoundTemperature_degC = 10.0;
inline constexpr double kRoundUt1MinusUtc_s = 0.03;

// Both with the truth of the world's unit and pose; deterministic.
CalibrationRound calibration_round(const World& world, std::size_t station);

}  // namespace ols::sim
