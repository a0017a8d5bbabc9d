// Exposure time and gain of a camera, and their limits.
#pragma once

namespace ols::camera {

struct ExposureSetting {
  double exposure_us = 0.0;
  double gain_dB = 0.0;
  bool operator==(const ExposureSetting&) const = default;
};

struct ExposureLimits {
  double exposure_min_us = 0.0, exposure_max_us = 0.0;
  double gain_min_dB = 0.0, gain_max_dB = 0.0;
};

}  // namespace ols::camera
