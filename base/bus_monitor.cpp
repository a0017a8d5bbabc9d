#include "base/bus_monitor.h"

namespace ols {
namespace {

BusTraffic operator+(const BusTraffic& a, const BusTraffic& b) {
  return {a.received + b.received, a.fragments + b.fragments, a.malformed + b.malformed,
          a.overflowed + b.overflowed, a.unsendable + b.unsendable};
}

}  // namespace

BusTraffic BusMonitor::total() const { return ended_ + current_; }

void BusMonitor::look(const BusTraffic& connection, double now_s) {
  if (is_calm(now_s)) calm_ = total();
  const bool more = connection.fragments > current_.fragments ||
                    connection.malformed > current_.malformed ||
                    connection.overflowed > current_.overflowed;
  if (more) refused_s_ = now_s;
  current_ = connection;
}

void BusMonitor::connection_ended() {
  ended_ = total();
  current_ = {};
}

void BusMonitor::count(std::map<std::string, double>& counters) const {
  const BusTraffic all = total();
  counters["bus_fragments_refused"] = static_cast<double>(all.fragments);
  counters["bus_datagrams_malformed"] = static_cast<double>(all.malformed);
  counters["bus_messages_overflowed"] = static_cast<double>(all.overflowed);
  counters["bus_messages_unsendable"] = static_cast<double>(all.unsendable);
}

std::string BusMonitor::alarm(double now_s) const {
  if (is_calm(now_s)) return {};
  const BusTraffic all = total();
  return "bus: " + std::to_string(all.fragments - calm_.fragments) + " fragments and " +
         std::to_string(all.malformed - calm_.malformed) + " malformed datagrams refused, " +
         std::to_string(all.overflowed - calm_.overflowed) +
         " messages displaced by newer ones: a flood, or a foreign program on the bus";
}

}  // namespace ols
