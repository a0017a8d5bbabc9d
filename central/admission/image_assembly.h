// Puts the bearings of one image together, which arrive as messages of their own. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "central/measurement/bearing_measurement.h"

namespace ols::fusion {

// The bearings of one station with one stamp, in order of arrival.
using ImageBearings = std::vector<BearingMeasurement>;

class ImageAssembly {
 public:
  // Takes a bearing; returns the images that are complete with it, oldest first. An image is
  // complete with the number of bearings that they state (a bearing that states none is an image);
  // or, if some have not come, with its station's next image, or kWaitS before `now`.
  std::vector<ImageBearings> add(const BearingMeasurement& measurement, std::int64_t now_us);
  void forget(const std::string& station) { open_.erase(station); }
  void clear() { open_.clear(); }

 private:
  static constexpr double kWaitS = 0.05;

  std::map<std::string, ImageBearings> open_;  // none is empty
};

}  // namespace ols::fusion
