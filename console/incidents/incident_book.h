// The areas and incidents of a console, with their pictures and alarms. Carries out people's
// requests, and says what must be stored, sent and recorded. Pure.
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

// A person's request to change the areas.
struct AreaChange {
  nlohmann::json area;  // the area to set; null: the request is to remove one
  std::string name;     // name of the area to remove
};
struct IncidentJudgement {
  std::uint64_t incident = 0;
  Judgement verdict = Judgement::kOpen;
};

// What stations record of an incident: the time before and after its beginning; both 0: nothing.
struct IncidentRecording {
  double before_s = 5.0, after_s = 15.0;
};

// The areas and incidents that survive a restart.
struct KeptIncidents {
  std::vector<Area> areas;
  bool may_change_areas = true;  // false: the areas could not be read
  std::vector<Incident> incidents;
  std::map<std::uint64_t, std::string> pictures;  // JPEG, by the incident's number
  std::uint64_t numbers = 0;                      // the highest number of any stored incident, even
                                                  // if it cannot be read
};

inline constexpr std::size_t kMostPictureBytes = 1'000'000;

class IncidentBook {
 public:
  explicit IncidentBook(const IncidentRecording& recording) : recording_(recording) {}

  // Restores what was stored. Call before anything else.
  void resume(KeptIncidents kept, double now_s);

  // `minute_of_day`: in the time zone of this host.
  void receive(const ReceivedTarget& target, int minute_of_day, double now_s);
  // Call often. `newest` returns a station's newest picture; null: there is none.
  void turn(double now_s, const std::function<const Picture*(const std::string&)>& newest);

  // Both return why the request is refused; empty: it was carried out.
  Outcome change(const AreaChange& change);
  Outcome judge(const IncidentJudgement& verdict, const std::string& who, std::int64_t utime_us);

  std::vector<Alarm> alarms() const;
  const IncidentWatch& watch() const { return watch_; }
  const std::string* picture(std::uint64_t incident) const;  // JPEG; null: none

  struct News {
    bool areas = false;
    std::set<std::uint64_t> incidents;  // incidents that were changed
    std::set<std::uint64_t> pictures;   // incidents with a new picture
    std::vector<std::uint64_t> forgotten;
  };
  // What has changed since the last call.
  News take_news();
  // The orders to stations to record, since the last call.
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

// Converts the fusion's message to a target that can be watched. nullopt: the target has no
// position, or is tentative.
std::optional<WatchedTarget> watched(const ReceivedTarget& target);

}  // namespace ols::console
