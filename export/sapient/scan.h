// The instants for which targets are reported. SAPIENT receivers report a clock fault if a node's
// next report is earlier than the last, or less than 0.08 s later. They accept any number of
// reports for one instant. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "export/records.h"

namespace ols::exports {

class Scan {
 public:
  // The instant for this target's report, at most kGap_s before the target's own time; nullopt: it
  // was already reported for that instant.
  std::optional<std::int64_t> instant_of(const Target& target);
  void begin_again() { told_.clear(); }

  static constexpr double kGap_s = 0.09;

 private:
  bool begins_at(std::int64_t utime_us) const;

  std::optional<std::int64_t> instant_us_;
  std::map<std::string, TrackState> told_;
};

}  // namespace ols::exports
