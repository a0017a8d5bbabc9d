// Decides which records go to one output, by kind, area and rate. Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>

#include "base/config/area.h"
#include "export/records.h"

namespace ols::exports {

struct GateConfig {
  bool targets = true, stations = true, lines = false;
  bool tentative = false;  // whether tentative targets pass too
  double rate_hz = 2.0;    // highest rate of records of one object
  Area area_deg{-90, -180, 90, 180};
};

// Records that come too early for the rate are dropped, not delayed, so that all output is recent.
// A change of a target's state passes at once. A target that leaves the area ends at its last place
// inside.
class Gate {
 public:
  explicit Gate(const GateConfig& config) : config_(config) {}

  std::optional<Target> pass(const Target& target);
  bool passes(const Station& station);
  bool passes(const Line& line);
  // The rate does not apply to incidents, because there are few.
  bool passes(const Incident& incident) const;

  // A line of sight passes only with at least this belief; the fusion has the same limit for
  // bearings.
  static constexpr double kLeastBelief = 0.5;

 private:
  struct Last {
    std::int64_t utime_us = 0;
    TrackState state = TrackState::kEnded;
    // The last exported place.
    Place place{};
    Covariance covariance_m2{};
  };
  bool is_inside(const Place& place) const;
  bool is_due(const std::string& uid, std::int64_t utime_us, TrackState state);

  GateConfig config_;
  std::unordered_map<std::string, Last> last_;
};

}  // namespace ols::exports
