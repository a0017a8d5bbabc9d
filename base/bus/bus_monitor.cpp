#include "base/bus/bus_monitor.h"

#include "conditions/alarms.h"

namespace ols {
namespace {

BusTraffic operator+(const BusTraffic& a, const BusTraffic& b) {
  BusTraffic sum{a.received + b.received,     a.fragments + b.fragments,
                 a.malformed + b.malformed,   a.overflowed + b.overflowed,
                 a.unsendable + b.unsendable, a.dropped + b.dropped};
  for (std::size_t i = 0; i < sum.distrusted.size(); ++i) {
    sum.distrusted[i] = a.distrusted[i] + b.distrusted[i];
  }
  sum.distrusted_last = b.distrusted_last.empty() ? a.distrusted_last : b.distrusted_last;
  sum.trust_trouble = b.trust_trouble;
  return sum;
}

// "2 unsigned, 1 replayed": what came since.
std::string reasons(const BusTraffic& now, const BusTraffic& before) {
  std::string text;
  for (std::size_t i = 0; i < now.distrusted.size(); ++i) {
    const std::uint64_t more = now.distrusted[i] - before.distrusted[i];
    if (more == 0) continue;
    text += (text.empty() ? "" : ", ") + std::to_string(more) + " " +
            trust::to_string(static_cast<trust::Distrust>(i));
  }
  return text;
}

}  // namespace

BusTraffic BusMonitor::total() const { return ended_ + current_; }

void BusMonitor::look(const BusTraffic& connection, double now_s) {
  if (is_calm(now_s)) calm_ = total();
  const bool more = connection.fragments > current_.fragments ||
                    connection.malformed > current_.malformed ||
                    connection.overflowed > current_.overflowed;
  if (more) refused_s_ = now_s;
  if (!distrusted_s_ || now_s - *distrusted_s_ > kAlarm_s) trusting_ = total();
  if (connection.distrusted != current_.distrusted) distrusted_s_ = now_s;
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
  counters["bus_datagrams_dropped"] = static_cast<double>(all.dropped);
  for (std::size_t i = 0; i < all.distrusted.size(); ++i) {
    const std::string reason = trust::to_string(static_cast<trust::Distrust>(i));
    if (all.distrusted[i] > 0) {
      counters["bus_distrusted_" + reason] = static_cast<double>(all.distrusted[i]);
    }
  }
}

Alarm BusMonitor::alarm(double now_s) const {
  if (is_calm(now_s)) return {};
  const BusTraffic all = total();
  return alarm::bus_flooded(all.fragments - calm_.fragments, all.malformed - calm_.malformed,
                            all.overflowed - calm_.overflowed);
}

Alarm BusMonitor::trust_alarm(double now_s) const {
  if (!current_.trust_trouble.empty()) return current_.trust_trouble;
  if (!distrusted_s_ || now_s - *distrusted_s_ > kAlarm_s) return {};
  const BusTraffic all = total();
  return alarm::messages_not_believed(reasons(all, trusting_), all.distrusted_last);
}

std::vector<Alarm> BusMonitor::alarms(double now_s) const {
  std::vector<Alarm> alarms;
  for (const Alarm& one : {alarm(now_s), trust_alarm(now_s)}) {
    if (!one.empty()) alarms.push_back(one);
  }
  return alarms;
}

}  // namespace ols
