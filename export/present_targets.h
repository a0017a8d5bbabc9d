// The present targets. Makes sure that each target's end is exported exactly once, with the
// target's last position: also if the fusion stops without reporting the end, or reports it without
// a position. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "export/records.h"

namespace ols::exports {

class PresentTargets {
 public:
  // Takes a record, and returns the records to export. Returns none for an older record, and for
  // the end of a target that is not present.
  std::vector<Target> take(const Target& target);
  // Ends the targets that were silent for kSilent_s, and returns a record of each end. `utime_us`:
  // now, by the clock of the records.
  std::vector<Target> end_silent(std::int64_t utime_us);
  std::size_t size() const { return live_.size(); }

  static constexpr double kSilent_s = 10.0;
  // Limit of the number of present targets, because forged messages may contain invented numbers.
  // Beyond the limit, the oldest target is ended.
  static constexpr std::size_t kMost = 2000;

 private:
  static Target ended(Target target, std::int64_t utime_us);

  std::map<std::string, Target> live_;
};

}  // namespace ols::exports
