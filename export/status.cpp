#include "export/status.h"

#include <nlohmann/json.hpp>

#include "conditions/alarm_json.h"

namespace ols::exports {

using Json = nlohmann::ordered_json;

std::string in_one_line(const ExportStatus& status) {
  std::string line = std::to_string(status.targets) + " targets";
  for (const Alarm& alarm : status.alarms) line.append("; ").append(alarm.text);
  for (const auto& [name, report] : status.outputs) {
    line.append("; ").append(name).append(": ");
    line.append(report.trouble.empty() ? std::to_string(report.sent) + " sent" : report.trouble);
  }
  return line;
}

std::string to_json(const ExportStatus& status) {
  Json outputs = Json::object();
  for (const auto& [name, report] : status.outputs) {
    outputs[name] = {{"open", report.is_open},        {"trouble", report.trouble},
                     {"sent", report.sent},           {"bytes", report.bytes},
                     {"displaced", report.displaced}, {"failures", report.failures},
                     {"openings", report.openings},   {"complaints", report.complaints}};
  }
  const Json json{{"utime_us", status.utime_us},
                  {"targets", status.targets},
                  {"alarms", status.alarms},
                  {"counters", status.counters},
                  {"outputs", std::move(outputs)}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace ols::exports
