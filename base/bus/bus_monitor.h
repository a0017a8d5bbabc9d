// Counters and alarms for refused and displaced bus traffic. Pure.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/bus/bus_inbox.h"
#include "conditions/alarm.h"

namespace ols {

class BusMonitor {
 public:
  // Call regularly with the counts of the current connection. `now_s`: monotonic.
  void look(const BusTraffic& connection, double now_s);
  // Call when the connection has ended, because the next connection counts from zero.
  void connection_ended();

  // Adds the counters, each summed over all connections: bus_fragments_refused,
  // bus_datagrams_malformed, bus_messages_overflowed, bus_messages_unsendable,
  // bus_datagrams_dropped. Where signatures are verified, also bus_distrusted_<reason> for the
  // reasons that have occurred.
  void count(std::map<std::string, double>& counters) const;
  // The alarm if traffic was refused or displaced within the last kAlarm_s; otherwise empty.
  Alarm alarm(double now_s) const;
  static constexpr double kAlarm_s = 10.0;
  // The alarm if messages failed verification within the last kAlarm_s, or if something is wrong
  // with the keys or the trust list; otherwise empty.
  Alarm trust_alarm(double now_s) const;
  // Whichever of these two alarms are active now.
  std::vector<Alarm> alarms(double now_s) const;

 private:
  BusTraffic total() const;
  bool is_calm(double now_s) const { return !refused_s_ || now_s - *refused_s_ > kAlarm_s; }

  BusTraffic ended_;                 // total of all earlier connections
  BusTraffic current_;               // the current connection
  BusTraffic calm_;                  // total when the last alarm ended, or at the start
  std::optional<double> refused_s_;  // time of the last refusal
  BusTraffic trusting_;              // total when the last trust alarm ended
  std::optional<double> distrusted_s_;
};

}  // namespace ols
