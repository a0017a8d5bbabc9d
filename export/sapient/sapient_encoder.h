// SAPIENT: the site as one node, with its targets. Lines are not there, since the standard counts
// bearings from the node, which has one place only. Pure.
#pragma once

#include <map>
#include <utility>

#include "export/encoder.h"
#include "export/sapient/sapient_messages.h"
#include "export/sapient/scan.h"

namespace ols::exports {

class SapientEncoder : public Encoder {
 public:
  explicit SapientEncoder(SapientSettings settings) : settings_(std::move(settings)) {}

  Packets encode(const Target& target) override;
  Packets encode(const Station& station) override;
  Packets encode(const Line&) override { return {}; }
  Packets turn(std::int64_t utime_us) override;
  void begin_again() override;

  static constexpr double kStationSilent_s = 10.0;  // then a station is not told of any more

 private:
  SapientSettings settings_;
  Scan scan_;
  std::map<std::string, Station> stations_;
  std::int64_t due_us_ = 0;  // of the next status
};

}  // namespace ols::exports
