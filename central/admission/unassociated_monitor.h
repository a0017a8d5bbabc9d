// Stations that follow, by a name of their own, what no target explains while there is a target:
// another object that nobody else has seen, or a wrong designation. Nobody can tell which from
// bearings, so that such a station's lines go on as they are; but a person should look. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace ols::fusion {

struct UnassociatedConfig {
  double alarm_s = 10.0;  // for so long without a bearing that a target explains
};

class UnassociatedMonitor {
 public:
  explicit UnassociatedMonitor(const UnassociatedConfig& config = {}) : config_(config) {}

  // A bearing that no target explains, though there is one; in the station's own time.
  void unassociated(const std::string& station, std::int64_t utime_us);
  // One that a target explains, or there is no target to compare with.
  void agrees(const std::string& station) { stations_.erase(station); }
  // What the station's bearings show, in words; empty: nothing. now_us: the fusion's time.
  std::string alarm(const std::string& station, std::int64_t now_us) const;
  void forget(const std::string& station) { stations_.erase(station); }
  void clear() { stations_.clear(); }

 private:
  struct Span {
    std::int64_t from_us = 0, to_us = 0;
  };
  UnassociatedConfig config_;
  std::map<std::string, Span> stations_;
};

}  // namespace ols::fusion
