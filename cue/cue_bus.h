// Sends cues on the bus. Receives nothing but its own self-test.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/bus/bus_client.h"
#include "base/trust/trust_config.h"
#include "cue/live_cues.h"

namespace ols::cues {

class CueBus : public BusClient {
 public:
  CueBus(std::string url, const trust::TrustConfig& trust);

  void send(const std::vector<LiveCue>& cues, std::int64_t utime_us);

 private:
  CueBus(std::string url, const trust::TrustConfig& trust, std::int64_t boot_id);

  const std::int64_t boot_id_;
  std::int64_t sequence_ = 0;
};

}  // namespace ols::cues
