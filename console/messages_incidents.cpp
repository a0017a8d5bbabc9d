#include "console/messages_incidents.h"

#include <cstdlib>

#include "base/bus/channel_names.h"
#include "ols_msg/incident_t.hpp"

namespace ols::console {
namespace {

using Message = ols_msg::incident_t;

static_assert(static_cast<int>(Judgement::kConfirmed) == Message::VERDICT_CONFIRMED);
static_assert(static_cast<int>(Judgement::kDismissed) == Message::VERDICT_DISMISSED);

constexpr std::int64_t kAgain_us = 1'000'000;

Message message_of(const Incident& incident) {
  Message m{};
  m.schema_version = Message::SCHEMA_VERSION;
  m.number = static_cast<std::int64_t>(incident.number);
  m.area = incident.area;
  m.target_boot_id = std::strtoll(incident.target.c_str(), nullptr, 10);
  m.target_id = std::strtoll(std::string(incident.target_number()).c_str(), nullptr, 10);
  m.object_class = incident.object_class;
  m.class_probability = incident.class_probability;
  m.begun_utime = incident.begun_us;
  m.ended_utime = incident.ended_us;
  m.entries = incident.entries;
  m.latitude_deg = incident.last.latitude_deg;
  m.longitude_deg = incident.last.longitude_deg;
  m.height_m = incident.last.height_m;
  m.verdict = static_cast<std::int8_t>(incident.verdict);
  m.judged_by = incident.judged_by;
  m.judged_utime = incident.judged_us;
  m.station = incident.stations;
  m.stations = static_cast<std::int16_t>(m.station.size());
  return m;
}

}  // namespace

bool IncidentSender::send(LcmBus& bus, const IncidentWatch& watch, const IncidentBook::News& news,
                          std::int64_t utime_us) {
  // A clock that was set back must not stop the repetition.
  const bool is_again = std::llabs(utime_us - repeated_us_) >= kAgain_us;
  if (is_again) repeated_us_ = utime_us;
  bool is_sent = true;
  for (const auto& [number, incident] : watch.incidents()) {
    if (!news.incidents.contains(number) && !(is_again && incident.is_inside())) continue;
    Message m = message_of(incident);
    m.utime = utime_us;
    m.boot_id = boot_id_;
    m.sequence = ++sequence_;
    is_sent = bus.publish(std::string(kIncidentChannel), m) && is_sent;
  }
  return is_sent;
}

}  // namespace ols::console
