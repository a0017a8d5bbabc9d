#include "central/admission/calibration_monitor.h"

#include <cmath>

#include "conditions/alarms.h"
#include "geometry/angles.h"

namespace ols::fusion {
namespace {

constexpr double kSigmas = 4.0;
constexpr double kArcsec = kPi / 648000.0;

}  // namespace

Alarm calibration_alarm(const std::string& station, const StatedCalibration& stated,
                        const FoundBias& found) {
  // A station that doubts its own calibration reports that itself.
  if (stated.state != CalibrationState::kInUse) return {};
  bool beyond = false;
  for (int axis = 0; axis < 2; ++axis) {
    beyond = beyond || std::abs(found.bias_rad[axis]) > kSigmas * found.stated_sd_rad[axis];
  }
  if (!beyond) return {};
  const auto arcsec = [](double rad) { return std::isnan(rad) ? 0.0 : rad / kArcsec; };
  return alarm::station_off_calibration(station, arcsec(found.bias_rad.x()),
                                        arcsec(found.bias_rad.y()));
}

}  // namespace ols::fusion
