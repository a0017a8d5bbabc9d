#include "sim/ptu/settings.h"

#include <cmath>

#include "geometry/angles.h"

namespace ols::sim {

PtuSettings factory_settings(const PtuUnitConfig& config) {
  const auto home_speed = static_cast<int>(
      std::lround(config.home_speed_rad_s / radians(config.resolution_arcsec / 3600.0)));
  const auto axis = [&config, home_speed](int least_counts, int greatest_counts) {
    return PtuAxisSettings{1000,
                           config.acceleration_counts_s2,
                           config.base_speed_counts_s,
                           config.max_speed_counts_s,
                           config.min_speed_counts_s,
                           'R',
                           'R',
                           'E',
                           least_counts,
                           greatest_counts,
                           home_speed};
  };
  return {true,
          PtuFeedback::kVerbose,
          {axis(config.pan_min_counts, config.pan_max_counts),
           axis(config.tilt_min_counts, config.tilt_max_counts)},
          0,
          false,
          false};
}

}  // namespace ols::sim
