#include "command/outcome.h"

namespace ols::command {
namespace {

// The refusal whose counter (`prefix` + reason) has grown; nothing if none has.
std::optional<std::string> new_refusal(const Reply& before, const Reply& now,
                                       const std::string& prefix) {
  for (const auto& [name, value] : now.counters) {
    if (!name.starts_with(prefix) || value <= counter(before, name)) continue;
    const std::string why = name.substr(prefix.size());
    if (why == "nothing_there") return "refused: nothing stands out there; draw a box";
    if (why == "stopped") return "refused: it is stopped; release it first";
    if (why == "just_stopped") return "refused: it was stopped less than a second ago; try again";
    // With the station's explanation if there is one ("RECORD refused: disk full").
    return "refused: " + why +
           (now.last_error != before.last_error ? " (" + now.last_error + ")" : "");
  }
  return std::nullopt;
}

}  // namespace

double counter(const Reply& reply, const std::string& name) {
  const auto found = reply.counters.find(name);
  return found == reply.counters.end() ? 0.0 : found->second;
}

std::optional<Outcome> outcome(const Reply& before, const Reply& now, Kind kind) {
  const std::string accepted = std::string(counted_as(kind)) + "_accepted";
  if (counter(now, accepted) > counter(before, accepted)) return Outcome{true, ""};
  if (auto refusal = new_refusal(before, now, "refused_")) return Outcome{false, *refusal};
  return std::nullopt;
}

Outcome without_answer(const Reply& before, const Reply& now) {
  return {false, new_refusal(before, now, "messages_refused_").value_or("no answer")};
}

bool confirms_stop(const Reply& now, double stops_before) {
  return counter(now, "stop_accepted") > stops_before && now.stopped;
}

}  // namespace ols::command
