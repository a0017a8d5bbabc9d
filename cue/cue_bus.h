// ols-cue on the bus: it sends cues, and hears nothing but itself. Retries while there is no
// network.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/bus_connector.h"
#include "base/bus_monitor.h"
#include "base/trust/trust_config.h"
#include "cue/cue_desk.h"

namespace ols::cues {

class CueBus {
 public:
  CueBus(std::string url, const trust::TrustConfig& trust);

  // Waits at most this long for the first connection.
  void connect(double now_s, double wait_s);
  // Waits at most this long.
  void turn(double now_s, int wait_ms);
  void send(const std::vector<LiveCue>& cues, std::int64_t utime_us);

  std::string trouble() const { return bus_ ? "" : "no bus: " + trouble_; }
  std::vector<std::string> alarms(double now_s) const { return monitor_.alarms(now_s); }
  void count(std::map<std::string, double>& counters) const { monitor_.count(counters); }

 private:
  void end(const std::string& why);

  std::string url_;
  std::int64_t boot_id_;
  std::int64_t sequence_ = 0;
  BusConnector connector_;
  std::unique_ptr<LcmBus> bus_;  // null: no network
  BusMonitor monitor_;
  std::string trouble_ = "connecting";
};

}  // namespace ols::cues
