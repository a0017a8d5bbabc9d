// Collects the bearings of one image, which arrive as separate messages. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "central/measurement/bearing_measurement.h"

namespace ols::fusion {

// The bearings of one station and image, in order of arrival.
using ImageBearings = std::vector<BearingMeasurement>;

class ImageAssembly {
 public:
  // Takes a bearing. Returns the images that it completes, oldest first. Each bearing states the
  // number of bearings in its image; the image is complete when that many have arrived. (A bearing
  // without a number is an image by itself.) If some are missing, the image counts as complete when
  // its station's next image begins, or when it is more than kWaitS older than `now`.
  std::vector<ImageBearings> add(const BearingMeasurement& measurement, std::int64_t now_us);
  void forget(const std::string& station) { open_.erase(station); }
  void clear() { open_.clear(); }

 private:
  static constexpr double kWaitS = 0.05;

  std::map<std::string, ImageBearings> open_;  // by station; no image is empty
};

}  // namespace ols::fusion
