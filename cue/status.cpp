#include "cue/status.h"

#include <nlohmann/json.hpp>

#include "conditions/alarm_json.h"

namespace ols::cues {

using Json = nlohmann::ordered_json;

std::string in_one_line(const CueStatus& status) {
  std::string line = std::to_string(status.cues) + " cues";
  for (const Alarm& alarm : status.alarms) line.append("; ").append(alarm.text);
  for (const InputStatus& input : status.inputs) {
    line.append("; ").append(input.name).append(": ");
    if (!input.trouble.empty()) {
      line.append(input.trouble);
      continue;
    }
    std::int64_t refused = 0;
    for (const auto& [why, count] : input.counts.refused) refused += count;
    line.append(std::to_string(input.counts.taken)).append(" taken");
    if (refused == 0) continue;
    line.append(", ").append(std::to_string(refused)).append(" refused (last ");
    line.append(input.counts.last_refusal).append(")");
  }
  return line;
}

std::string to_json(const CueStatus& status) {
  Json inputs = Json::object();
  for (const InputStatus& input : status.inputs) {
    inputs[input.name] = {{"open", input.is_open},
                          {"trouble", input.trouble},
                          {"taken", input.counts.taken},
                          {"refused", input.counts.refused},
                          {"last_refusal", input.counts.last_refusal},
                          {"bytes", input.bytes},
                          {"failures", input.failures},
                          {"openings", input.openings}};
  }
  const Json json{{"utime_us", status.utime_us},
                  {"cues", status.cues},
                  {"alarms", status.alarms},
                  {"counters", status.counters},
                  {"inputs", std::move(inputs)}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace ols::cues
