// When a frame was exposed, on the station's monotonic clock. Pure.
#pragma once

#include <cstdint>
#include <optional>

#include "edge/camera/camera_config.h"
#include "edge/camera/clock_map.h"
#include "edge/camera/exposure_log.h"
#include "edge/camera/frame.h"

namespace ols::camera {

struct FrameTime {
  double mid_exposure_s = 0.0;
  double sd_s = 0.0;
  StampSource source = StampSource::kCamera;
};

// Where TAI, the time of a PTP slave, stands on the station's monotonic clock: by way of the
// station's own UTC and the leap seconds.
struct TaiReference {
  std::int64_t monotonic_minus_tai_ns = 0;
  double sd_s = 0.0;  // 1-sigma, of the station's UTC and of the master together
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

  // While the camera's clock is TAI and the station's UTC is to be trusted; otherwise nothing. It
  // is a second opinion beside the latches: the better of the two counts as long as they agree, the
  // latches when they do not.
  void set_tai(const std::optional<TaiReference>& reference) { tai_ = reference; }
  // By how much PTP differs from the latches [s], when that is more than both can explain.
  std::optional<double> tai_disagreement_s() const { return tai_disagreement_s_; }

  // The camera's stamp, or nothing when it has none of its own; the arrival of the frame's first
  // packet; and the exposures that were set.
  FrameTime stamp(std::optional<std::int64_t> device_ns, double arrival_s,
                  const ExposureLog& exposures);

 private:
  MappedTime with_tai(const MappedTime& latched, std::int64_t device_ns);
  FrameTime from_mark(const MappedTime& mark, bool at_start, const ExposureLog& exposures,
                      StampSource source) const;

  Config config_;
  ClockMap map_;
  std::optional<TaiReference> tai_;
  std::optional<double> tai_disagreement_s_;
};

}  // namespace ols::camera
