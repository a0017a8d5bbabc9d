// MQTT messages with targets, stations and lines of sight as flat JSON. Home Assistant finds them
// by itself, because the encoder also sends the messages of its MQTT discovery. Pure.
//
// PREFIX consists of the configured prefix ([mqtt] prefix) and the name of the site, so that
// several sites can share a broker.
//
//   PREFIX/status           "online" or "offline" (the last will)
//   PREFIX/targets          every target
//   PREFIX/target/SLOT      the target in this slot, retained; {"state": "none"} while it is free,
//                           repeated before it becomes stale
//   PREFIX/station/NAME     the status of the station, retained
//   PREFIX/line/NAME        the station's line of sight
//   PREFIX/incidents        every target in a watched area, each second and when the incident
//                           changes
#pragma once

#include <cstdint>
#include <set>
#include <string>

#include "export/encoder.h"
#include "export/mqtt/mqtt_settings.h"
#include "export/mqtt/target_slots.h"

namespace ols::exports {

class MqttEncoder : public Encoder {
 public:
  MqttEncoder(MqttSettings settings, std::string site);

  Packets encode(const Target& target) override;
  Packets encode(const Station& station) override;
  Packets encode(const Line& line) override;
  Packets encode_incident(const Incident& incident) override;
  Packets due(std::int64_t utime_us) override;
  void begin_again() override;

 private:
  bool is_free_slot_due(std::int64_t utime_us) const;

  MqttSettings settings_;
  std::string site_, prefix_;
  TargetSlots slots_;
  bool slots_are_announced_ = false;
  std::int64_t free_due_us_ = 0;  // when the messages of free slots are due again
  std::set<std::string> announced_stations_;
};

// The beginning of all topics of the site.
std::string site_prefix(const MqttSettings& settings, const std::string& site);
// The topic of the site's availability, on which the broker also publishes the last will.
std::string status_topic(const MqttSettings& settings, const std::string& site);
// Makes a name fit for one level of a topic: replaces all characters except letters, digits, - and
// _ with "_".
std::string topic_word(const std::string& name);

}  // namespace ols::exports
