#include "central/admission/image_assembly.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "central/measurement/time_span.h"

namespace ols::fusion {

namespace {

constexpr double kReadout_s = 0.025;  // less than the interval between images

// With a rolling shutter, each object has the time of its own image row.
bool is_of(const ImageBearings& image, const BearingMeasurement& measurement, double readout_s) {
  const BearingMeasurement& first = image.front();
  if (first.utime_us == measurement.utime_us) return true;
  return measurement.image_bearings > 0 && measurement.image_bearings == first.image_bearings &&
         std::abs(seconds(measurement.utime_us - first.utime_us)) <= readout_s &&
         std::ranges::find(image, measurement.track_id, &BearingMeasurement::track_id) ==
             image.end();
}

}  // namespace

std::vector<ImageBearings> ImageAssembly::add(const BearingMeasurement& measurement,
                                              std::int64_t now_us) {
  std::vector<ImageBearings> complete;
  std::erase_if(open_, [&](auto& entry) {
    const std::int64_t utime_us = entry.second.front().utime_us;
    const bool is_own = entry.first == measurement.station;
    const bool is_over = is_own ? !is_of(entry.second, measurement, kReadout_s)
                                : seconds(now_us - utime_us) > kWaitS;
    if (!is_over) return false;
    complete.push_back(std::move(entry.second));
    return true;
  });
  std::ranges::stable_sort(complete, {},
                           [](const ImageBearings& image) { return image.front().utime_us; });
  ImageBearings& own = open_[measurement.station];
  own.push_back(measurement);
  if (std::ssize(own) < measurement.image_bearings) return complete;
  complete.push_back(std::move(own));
  open_.erase(measurement.station);
  return complete;
}

}  // namespace ols::fusion
