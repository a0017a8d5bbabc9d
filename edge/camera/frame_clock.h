// When a frame was exposed, on the station's monotonic clock. Pure.
#pragma once

#include <cstdint>
#include <optional>

#include "edge/camera/camera_config.h"
#include "edge/camera/clock_map.h"
#include "edge/camera/frame.h"

namespace ols {

struct FrameTime {
  double mid_exposure_s = 0.0;
  double sd_s = 0.0;
  StampSource source = StampSource::kCamera;
};

class FrameClock {
 public:
  struct Config {
    StampAt stamp_at = StampAt::kExposureStart;
    double readout_s = 0.010;  // end of exposure to arrival
    double readout_sd_s = 0.010;
    ClockMap::Config map;
  };
  explicit FrameClock(const Config& config) : config_(config), map_(config.map) {}

  ClockMap& map() { return map_; }

  // The camera's stamp, or nothing when it has none of its own, the arrival of the frame's first
  // packet, and the exposure that was set.
  FrameTime stamp(std::optional<std::int64_t> device_ns, double arrival_s, double exposure_s);

 private:
  Config config_;
  ClockMap map_;
};

}  // namespace ols
