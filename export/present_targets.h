// The present targets. Reports the end of each once, with its last position. The end is also
// reported if the fusion has stopped before reporting it, or has reported it without a position.
// Pure.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "export/records.h"

namespace ols::exports {

class PresentTargets {
 public:
  // The records to export; empty for the end of a target that was never present.
  std::vector<Target> take(const Target& target);
  // The ends of targets that were silent for kSilent_s. `utime_us`: now, in the time of the
  // records.
  std::vector<Target> end_silent(std::int64_t utime_us);
  std::size_t size() const { return live_.size(); }

  static constexpr double kSilent_s = 10.0;
  // A limit against forged messages with invented numbers; beyond it, the oldest targets are ended.
  static constexpr std::size_t kMost = 2000;

 private:
  static Target ended(Target target, std::int64_t utime_us);

  std::map<std::string, Target> live_;
};

}  // namespace ols::exports
