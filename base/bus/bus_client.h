// A program's connection to the bus. It tries to connect every second while there is no network,
// closes a connection that no longer receives anything, and reports each trouble once. Use it in
// one thread.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/bus/bus_connector.h"
#include "base/bus/bus_monitor.h"
#include "conditions/alarm.h"

namespace ols {

class BusClient {
 public:
  using Subscribe = std::function<void(LcmBus&)>;
  // Receives the reason when the connection is lost, and an empty text when there is a connection
  // again.
  using Tell = std::function<void(const std::string& trouble)>;

  // subscribe: called on each new connection. tell: receives each trouble; it is also logged.
  // trust: null if nothing is signed or verified.
  BusClient(std::string url, std::shared_ptr<trust::BusTrust> trust, Subscribe subscribe = {},
            Tell tell = {});

  // Tries to connect; waits at most wait_s for the connection. `now_s`: monotonic.
  void connect(double now_s, double wait_s);
  // With a connection: handles the messages that have arrived, waits at most wait_ms for the first,
  // and closes the connection if it no longer receives anything. Without a connection: tries to
  // connect, and waits wait_ms if that fails. `now_s`: monotonic.
  void turn(double now_s, int wait_ms);

  // The two parts of turn(), for a caller with work between them. Both need a connection.
  void handle(double now_s, int wait_ms);
  void end_if_deaf();

  // Closes a connection that does not work, and reports `why`; turn() opens it again.
  void end(const std::string& why);

  LcmBus* bus() const { return bus_.get(); }  // null: no network
  const std::string& url() const { return url_; }
  // Why there is no connection; empty if there is one.
  Alarm trouble() const;
  // Alarms about the traffic.
  std::vector<Alarm> alarms(double now_s) const { return monitor_.alarms(now_s); }
  // All alarms: the missing connection, and those about the traffic.
  std::vector<Alarm> all_alarms(double now_s) const;
  void count(std::map<std::string, double>& counters) const { monitor_.count(counters); }

 private:
  void say(const std::string& why);

  const std::string url_;
  const Subscribe subscribe_;
  const Tell tell_;
  BusConnector connector_;
  std::unique_ptr<LcmBus> bus_;
  BusMonitor monitor_;
  std::string trouble_;  // the trouble reported last; empty again once connected
};

}  // namespace ols
