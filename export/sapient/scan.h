// The instants for which targets are reported. A SAPIENT receiver reports a clock fault if a node's
// report is earlier than the node's previous one, or less than 0.08 s later. It accepts any number
// of reports for the same instant. Therefore, targets are reported for common instants. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "export/records.h"

namespace ols::exports {

class Scan {
 public:
  // The instant for which to report this target: less than kGap_s before the target's own time, and
  // at most one second after it. nullopt: the target was already reported, with the same state, for
  // that instant.
  std::optional<std::int64_t> instant_of(const Target& target);
  void begin_again() { told_.clear(); }

  static constexpr double kGap_s = 0.09;

 private:
  bool begins_at(std::int64_t utime_us) const;

  std::optional<std::int64_t> instant_us_;
  std::map<std::string, TrackState> told_;
};

}  // namespace ols::exports
