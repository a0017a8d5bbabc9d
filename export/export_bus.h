// ols-export on the bus: it only listens. Retries while there is no network.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/bus_connector.h"
#include "base/bus_monitor.h"

namespace ols::exports {

inline constexpr const char* kMemberName = "export";  // of the site

class ExportBus {
 public:
  using Handler = std::function<void(const BusMessage&)>;
  // The handler gets targets, stations' statuses, and bearings.
  ExportBus(std::string url, const trust::TrustConfig& trust, Handler handler);

  // Handles what has arrived; waits at most this long for the first.
  void turn(double now_s, int wait_ms);
  // Waits for the first connection.
  void connect(double now_s, double wait_s);

  std::string trouble() const { return bus_ ? "" : "no bus: " + trouble_; }
  std::vector<std::string> alarms(double now_s) const { return monitor_.alarms(now_s); }
  void count(std::map<std::string, double>& counters) const { monitor_.count(counters); }

 private:
  std::string url_;
  Handler handler_;
  BusConnector connector_;
  std::unique_ptr<LcmBus> bus_;  // null: no network
  BusMonitor monitor_;
  std::string trouble_ = "connecting";
};

}  // namespace ols::exports
