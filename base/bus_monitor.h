// Counters and alarm for refused and displaced bus traffic. Pure.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "base/bus_inbox.h"

namespace ols {

class BusMonitor {
 public:
  // Call regularly with the counts of the current connection. `now_s`: monotonic.
  void look(const BusTraffic& connection, double now_s);
  // The next connection counts from zero again.
  void connection_ended();

  // Counters that only go up over all connections: bus_fragments_refused, bus_datagrams_malformed,
  // bus_messages_overflowed, bus_messages_unsendable.
  void count(std::map<std::string, double>& counters) const;
  // The alarm text while traffic was refused or displaced within the last kAlarm_s; else empty.
  std::string alarm(double now_s) const;
  static constexpr double kAlarm_s = 10.0;

 private:
  BusTraffic total() const;
  bool is_calm(double now_s) const { return !refused_s_ || now_s - *refused_s_ > kAlarm_s; }

  BusTraffic ended_;                 // of all earlier connections
  BusTraffic current_;               // of this one
  BusTraffic calm_;                  // total when the last alarm was over
  std::optional<double> refused_s_;  // time of the last refusal
};

}  // namespace ols
