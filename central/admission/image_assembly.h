// Collects the bearings of one image. They arrive as separate messages. Pure.
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
  // Takes a bearing. Returns the images that are now complete, oldest first. Each bearing states
  // the number of bearings in its image; the image is complete when all of them have arrived. (A
  // bearing that states no number is an image by itself.) If bearings are missing, the image counts
  // as complete when its station's next image begins, or when the image is more than kWaitS older
  // than now_us.
  std::vector<ImageBearings> add(const BearingMeasurement& measurement, std::int64_t now_us);
  void forget(const std::string& station) { open_.erase(station); }
  void clear() { open_.clear(); }

 private:
  static constexpr double kWaitS = 0.05;

  std::map<std::string, ImageBearings> open_;  // by station; no image is empty
};

}  // namespace ols::fusion
