#include "edge/command/refusal_log.h"

#include "conditions/refusal.h"

namespace ols::station {

void RefusalLog::note(const std::string& what) {
  last_ = what;
  ++number_;
}

void RefusalLog::count(const std::string& why) {
  counters_["messages_refused"] += 1;
  counters_["messages_refused_" + why] += 1;
}

void RefusalLog::refuse(const std::string& kind, const std::string& why) {
  count(why);
  note(refused_in_words(kind, why));
}

// The next slew takes the place of one that came late: only many of them are worth a word.
void RefusalLog::refuse_at_gate(const std::string& kind, const std::string& why, double now_s) {
  const bool is_slew = kind == "SLEW";
  at_gate_.note(is_slew ? "slews" : kind + " commands", why, now_s);
  if (is_slew) return count(why);
  refuse(kind, why);
}

}  // namespace ols::station
