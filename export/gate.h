// What of the records goes to one output: kinds, area, and how often. Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>

#include "base/area.h"
#include "export/records.h"

namespace ols::exports {

struct GateConfig {
  bool targets = true, stations = true, lines = false;
  bool tentative = false;  // targets that are not confirmed yet, too
  double rate_hz = 2.0;    // of each object, at most
  Area area_deg{-90, -180, 90, 180};
};

// Records between two that may pass are left out, not delayed: what goes out is new. A change of a
// target's state passes at once. A target that leaves the area ends there.
class Gate {
 public:
  explicit Gate(const GateConfig& config) : config_(config) {}

  std::optional<Target> pass(const Target& target);
  bool passes(const Station& station);
  bool passes(const Line& line);

  static constexpr double kLeastBelief = 0.5;  // of a line; as the fusion's own limit

 private:
  struct Last {
    std::int64_t utime_us = 0;
    TrackState state = TrackState::kEnded;
    // Where it was told to be.
    Place place{};
    Covariance covariance_m2{};
  };
  bool is_inside(const Place& place) const;
  bool is_due(const std::string& uid, std::int64_t utime_us, TrackState state);

  GateConfig config_;
  std::unordered_map<std::string, Last> last_;
};

}  // namespace ols::exports
