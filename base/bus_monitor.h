// What a program on the bus says of the traffic that it had to refuse. Pure.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "base/bus_inbox.h"

namespace ols {

class BusMonitor {
 public:
  // The counts of the present connection, now and then. `now_s`: monotonic.
  void look(const BusTraffic& connection, double now_s);
  // The counts of the next connection begin at zero again.
  void connection_ended();

  // Counters that only go up over all connections: bus_fragments_refused, bus_datagrams_malformed,
  // bus_messages_overflowed, bus_messages_unsendable.
  void count(std::map<std::string, double>& counters) const;
  // In words, while something was refused or pushed out within the last kAlarm_s; else empty.
  std::string alarm(double now_s) const;
  static constexpr double kAlarm_s = 10.0;

 private:
  BusTraffic total() const;
  bool is_calm(double now_s) const { return !refused_s_ || now_s - *refused_s_ > kAlarm_s; }

  BusTraffic ended_;                 // of all connections before this one
  BusTraffic current_;               // of this one
  BusTraffic calm_;                  // total when the last alarm was over
  std::optional<double> refused_s_;  // when something was last refused
};

}  // namespace ols
