#include "central/admission/image_assembly.h"

#include <algorithm>
#include <utility>

#include "central/measurement/time_span.h"

namespace ols::fusion {

std::vector<ImageBearings> ImageAssembly::add(const BearingMeasurement& measurement,
                                              std::int64_t now_us) {
  std::vector<ImageBearings> complete;
  std::erase_if(open_, [&](auto& entry) {
    const std::int64_t utime_us = entry.second.front().utime_us;
    const bool is_own = entry.first == measurement.station;
    const bool is_over =
        is_own ? utime_us != measurement.utime_us : seconds(now_us - utime_us) > kWaitS;
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
