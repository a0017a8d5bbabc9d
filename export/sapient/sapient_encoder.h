// SAPIENT messages: the site is one node, which detects the targets. Lines of sight are not sent,
// because SAPIENT measures bearings from the node's place, and a node has only one place. Pure.
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
  Packets due(std::int64_t utime_us) override;
  void begin_again() override;

  static constexpr double kStationSilent_s = 10.0;  // a station that is silent for longer is not
                                                    // reported

 private:
  SapientSettings settings_;
  Scan scan_;
  std::map<std::string, Station> stations_;
  std::int64_t due_us_ = 0;  // when the next status is due
};

}  // namespace ols::exports
