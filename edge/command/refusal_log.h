// Records messages that the station refused, and messages that were refused before they reached it.
// It keeps their number, the text of the last refusal, and an alarm if CommandGate repeatedly
// refuses commands. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "conditions/alarm.h"
#include "edge/command/refusal_monitor.h"

namespace ols::station {

class RefusalLog {
 public:
  // Notes an action that the station did not carry out. `what`: the reason, for a person.
  void note(const std::string& what);
  // Notes a message that was refused before it reached the station. `kind`: for example "SLEW".
  void refuse(const std::string& kind, const std::string& why);
  // Notes a command that CommandGate has refused.
  void refuse_at_gate(const std::string& kind, const std::string& why, double now_s);

  const std::string& last() const { return last_; }
  std::uint64_t number() const { return number_; }
  std::vector<Alarm> alarms(double now_s) const { return at_gate_.alarms(now_s); }
  const std::map<std::string, double>& counters() const { return counters_; }

 private:
  void count(const std::string& why);

  RefusalMonitor at_gate_;
  std::map<std::string, double> counters_;
  std::string last_;
  std::uint64_t number_ = 0;
};

}  // namespace ols::station
