// The areas and incidents of a console: who may change them, their pictures and alarms, and what
// must be written, sent and recorded. Pure.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "conditions/alarm.h"
#include "conditions/refusal.h"
#include "console/incidents/incident_watch.h"
#include "console/received.h"
#include "wire/order.h"

namespace ols::console {

// What a person has requested. If it is refused, the answer says why in words.
struct AreaChange {
  nlohmann::json area;  // the area to set; null: remove one
  std::string name;     // of the area to remove
};
struct IncidentJudgement {
  std::uint64_t incident = 0;
  Judgement verdict = Judgement::kOpen;
};

// How long stations record before and after the beginning of an incident; both 0: not at all.
struct IncidentRecording {
  double before_s = 5.0, after_s = 15.0;
};

// What survives a restart.
struct KeptIncidents {
  std::vector<Area> areas;
  bool may_change_areas = true;  // false: they could not be read
  std::vector<Incident> incidents;
  std::map<std::uint64_t, std::string> pictures;  // JPEG, by incident
  std::uint64_t numbers = 0;                      // the highest number of an incident, readable or
                                                  // not
};

inline constexpr std::size_t kMostPictureBytes = 1'000'000;

class IncidentBook {
 public:
  explicit IncidentBook(const IncidentRecording& recording) : recording_(recording) {}

  // Call before anything else, with what was kept.
  void resume(KeptIncidents kept, double now_s);

  // `minute_of_day`: in the time zone of this host.
  void receive(const ReceivedTarget& target, int minute_of_day, double now_s);
  // Call often. `newest` returns a station's newest picture; null: there is none.
  void turn(double now_s, const std::function<const Picture*(const std::string&)>& newest);

  // Both return why the request is refused; empty: it is carried out.
  Outcome change(const AreaChange& change);
  Outcome judge(const IncidentJudgement& verdict, const std::string& who, std::int64_t utime_us);

  std::vector<Alarm> alarms() const;
  const IncidentWatch& watch() const { return watch_; }
  const std::string* picture(std::uint64_t incident) const;  // JPEG; null: none

  struct News {
    bool areas = false;
    std::set<std::uint64_t> incidents;  // changed ones
    std::set<std::uint64_t> pictures;   // new
    std::vector<std::uint64_t> forgotten;
  };
  // What has changed since the last call.
  News take_news();
  // Orders for the stations to record, since the last call.
  std::vector<wire::Order> take_recordings() { return std::exchange(recordings_, {}); }

 private:
  void add_pictures(const std::function<const Picture*(const std::string&)>& newest);

  IncidentRecording recording_;
  IncidentWatch watch_;
  bool may_change_areas_ = true;
  std::map<std::uint64_t, std::string> pictures_;
  std::vector<wire::Order> recordings_;
  News news_;
};

// A target whose position can be used, from the fusion's message; nullopt: it has no such position.
std::optional<WatchedTarget> watched(const ReceivedTarget& target);

}  // namespace ols::console
