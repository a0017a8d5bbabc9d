// Counters and alarm for refused and displaced bus traffic. Pure.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/bus_inbox.h"

namespace ols {

class BusMonitor {
 public:
  // Call regularly with the counts of the current connection. `now_s`: monotonic.
  void look(const BusTraffic& connection, double now_s);
  // The next connection counts from zero again.
  void connection_ended();

  // Counters that only go up over all connections: bus_fragments_refused, bus_datagrams_malformed,
  // bus_messages_overflowed, bus_messages_unsendable, bus_datagrams_dropped; where signatures are
  // verified, bus_distrusted_<reason> of those that have occurred.
  void count(std::map<std::string, double>& counters) const;
  // The alarm text while traffic was refused or displaced within the last kAlarm_s; else empty.
  std::string alarm(double now_s) const;
  static constexpr double kAlarm_s = 10.0;
  // The same of messages that were not believed, and of keys and trust list.
  std::string trust_alarm(double now_s) const;
  // Those of the two that stand.
  std::vector<std::string> alarms(double now_s) const;

 private:
  BusTraffic total() const;
  bool is_calm(double now_s) const { return !refused_s_ || now_s - *refused_s_ > kAlarm_s; }

  BusTraffic ended_;                 // of all earlier connections
  BusTraffic current_;               // of this one
  BusTraffic calm_;                  // total when the last alarm was over
  std::optional<double> refused_s_;  // time of the last refusal
  BusTraffic trusting_;              // total when the last alarm of trust was over
  std::optional<double> distrusted_s_;
};

}  // namespace ols
