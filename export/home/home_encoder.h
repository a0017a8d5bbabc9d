// MQTT: flat JSON of targets, stations and lines, and what Home Assistant needs to find them by
// itself (its MQTT discovery). Pure.
//
// PREFIX is [mqtt] prefix and the name of the site: several sites may have one broker.
//
//   PREFIX/status           "online" or "offline" (the last will)
//   PREFIX/targets          every target
//   PREFIX/target/SLOT      the target in this slot, retained; {"state": "none"} while it is free,
//                           said again before that is old news
//   PREFIX/station/NAME     retained
//   PREFIX/line/NAME        what this station sees
#pragma once

#include <cstdint>
#include <set>
#include <string>

#include "export/encoder.h"
#include "export/home/home_settings.h"
#include "export/home/target_slots.h"

namespace ols::exports {

class HomeEncoder : public Encoder {
 public:
  HomeEncoder(HomeSettings settings, std::string site);

  Packets encode(const Target& target) override;
  Packets encode(const Station& station) override;
  Packets encode(const Line& line) override;
  Packets turn(std::int64_t utime_us) override;
  void begin_again() override;

 private:
  bool is_free_slot_due(std::int64_t utime_us) const;

  HomeSettings settings_;
  std::string site_, prefix_;
  TargetSlots slots_;
  bool slots_are_told_ = false;
  std::int64_t free_due_us_ = 0;  // when it is said again which slots are free
  std::set<std::string> told_stations_;
};

// What the site's topics begin with.
std::string site_prefix(const HomeSettings& settings, const std::string& site);
// The topic of its availability: that of the last will.
std::string status_topic(const HomeSettings& settings, const std::string& site);
// A name as a level of a topic: what is no letter, digit, - or _ becomes "_".
std::string topic_word(const std::string& name);

}  // namespace ols::exports
