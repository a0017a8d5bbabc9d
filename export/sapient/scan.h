// At which instants targets are reported: receivers of SAPIENT take reports of one node that come
// less than 0.08 s after another, or before it, for a fault of its clock, but any number of one
// instant. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "export/records.h"

namespace ols::exports {

class Scan {
 public:
  // The instant to tell this target at, at most kGap_s before its own; nothing: it has been told at
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
