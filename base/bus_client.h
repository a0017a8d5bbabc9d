// A program's connection to the bus: tried again every second while there is no network, ended when
// nothing arrives any more, and its trouble said once. Needs one thread.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/bus_connector.h"
#include "base/bus_monitor.h"

namespace ols {

class BusClient {
 public:
  using Subscribe = std::function<void(LcmBus&)>;
  // Why there is no connection; empty: it is back.
  using Tell = std::function<void(const std::string& trouble)>;

  // subscribe: called on each new connection. tell: besides the log. trust: null: nothing is signed
  // or verified.
  BusClient(std::string url, std::shared_ptr<trust::BusTrust> trust, Subscribe subscribe = {},
            Tell tell = {});

  // Waits at most this long for a connection.
  void connect(double now_s, double wait_s);
  // Handles what has arrived, waits at most this long for the first, and looks whether anything
  // arrives at all; without a connection, tries to connect.
  void turn(double now_s, int wait_ms);

  // The parts of a turn, for a caller that does something between them. Only with a connection.
  void handle(double now_s, int wait_ms);
  void end_if_deaf();

  // Closes a connection that does not work, so that it is opened again.
  void end(const std::string& why);

  LcmBus* bus() const { return bus_.get(); }  // null: no network
  const std::string& url() const { return url_; }
  // Empty: there is a connection.
  std::string trouble() const;
  // Of the traffic.
  std::vector<std::string> alarms(double now_s) const { return monitor_.alarms(now_s); }
  // All that is wrong: that there is no connection, and the alarms of the traffic.
  std::vector<std::string> all_alarms(double now_s) const;
  void count(std::map<std::string, double>& counters) const { monitor_.count(counters); }

 private:
  void say(const std::string& why);

  const std::string url_;
  const Subscribe subscribe_;
  const Tell tell_;
  BusConnector connector_;
  std::unique_ptr<LcmBus> bus_;
  BusMonitor monitor_;
  std::string trouble_;  // the last that was said; empty: none since the connection
};

}  // namespace ols
