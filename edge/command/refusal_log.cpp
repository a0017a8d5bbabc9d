#include "edge/command/refusal_log.h"

namespace ols::station {

void RefusalLog::note(const std::string& what) {
  last_ = what;
  ++number_;
}

void RefusalLog::refuse(const std::string& kind, const std::string& why) {
  counters_["messages_refused"] += 1;
  counters_["messages_refused_" + why] += 1;
  note(kind + " refused: " + why);
}

void RefusalLog::refuse_at_gate(const std::string& kind, const std::string& why, double now_s) {
  at_gate_.note(kind == "SLEW" ? "slews" : kind + " commands", why, now_s);
  refuse(kind, why);
}

}  // namespace ols::station
