// Computes the mid-exposure time of a frame on the station's monotonic clock. Pure.
#pragma once

#include <cstdint>
#include <optional>

#include "edge/camera/clock_map.h"
#include "edge/camera/exposure_log.h"
#include "edge/camera/frame.h"

namespace ols::camera {

// The instant that the camera's time stamp refers to; it depends on the camera's model.
enum class StampAt { kExposureStart, kExposureEnd };

struct FrameTime {
  double mid_exposure_s = 0.0;
  double sd_s = 0.0;
  StampSource source = StampSource::kCamera;
};

// Converts TAI, the time of a PTP slave, to the station's monotonic clock. The difference of the
// two is computed from the station's UTC and the leap seconds.
struct TaiReference {
  std::int64_t monotonic_minus_tai_ns = 0;
  double sd_s = 0.0;  // 1-sigma of the station's UTC and of the PTP master's time together
};

class FrameClock {
 public:
  struct Config {
    StampAt stamp_at = StampAt::kExposureStart;
    // From the end of the exposure to the arrival of the frame's first packet.
    double readout_s = 0.010;
    double readout_sd_s = 0.010;
    ClockMap::Config map;
  };
  explicit FrameClock(const Config& config) : config_(config), map_(config.map) {}

  ClockMap& map() { return map_; }

  // Call with a reference while the camera's clock is TAI and the station's UTC can be trusted,
  // otherwise with nullopt. The reference is a second source of a frame's time besides the latches.
  // The more accurate source is used; if the two disagree, the latches are used.
  void set_tai(const std::optional<TaiReference>& reference) { tai_ = reference; }
  // Time by PTP minus time by the latches [s]; set only if their uncertainties do not explain the
  // difference.
  std::optional<double> tai_disagreement_s() const { return tai_disagreement_s_; }

  // `device_ns`: the camera's stamp of the frame; nullopt if there is none. `arrival_s`:
  // CLOCK_MONOTONIC at the arrival of the frame's first packet.
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
