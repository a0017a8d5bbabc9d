// The areas and incidents of a console: who may change them, the pictures, the alarms, and what is
// to be written, sent and recorded. Pure.
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
#include "console/heard.h"
#include "console/incidents/incident_watch.h"
#include "wire/order.h"

namespace ols::console {

// What a person has asked for. Both are refused in words.
struct AreaChange {
  nlohmann::json area;  // to be set; null: to be removed
  std::string name;     // of the one to be removed
};
struct IncidentJudgement {
  std::uint64_t incident = 0;
  Judgement verdict = Judgement::kOpen;
};

// How long stations record an incident before and after its begin; both 0: not at all.
struct IncidentRecording {
  double before_s = 5.0, after_s = 15.0;
};

// What is kept over a restart.
struct KeptIncidents {
  std::vector<Area> areas;
  bool may_change_areas = true;  // false: they could not be read
  std::vector<Incident> incidents;
  std::map<std::uint64_t, std::string> pictures;  // JPEG, by incident
  std::uint64_t numbers = 0;                      // the highest of an incident, readable or not
};

inline constexpr std::size_t kMostPictureBytes = 1'000'000;

class IncidentBook {
 public:
  explicit IncidentBook(const IncidentRecording& recording) : recording_(recording) {}

  // Before anything else: what was kept.
  void resume(KeptIncidents kept, double now_s);

  // `minute_of_day`: local.
  void hear(const TargetHeard& target, int minute_of_day, double now_s);
  // Call often. `newest`: a station's newest picture; null: none.
  void turn(double now_s, const std::function<const Picture*(const std::string&)>& newest);

  // Why not; empty: it is done.
  Outcome change(const AreaChange& change);
  Outcome judge(const IncidentJudgement& verdict, const std::string& who, std::int64_t utime_us);

  std::vector<Alarm> alarms() const;
  const IncidentWatch& watch() const { return watch_; }
  const std::string* picture(std::uint64_t incident) const;  // JPEG; null: none

  struct News {
    bool areas = false;
    std::set<std::uint64_t> incidents;  // changed
    std::set<std::uint64_t> pictures;   // new
    std::vector<std::uint64_t> forgotten;
  };
  // Since the last call.
  News take_news();
  // To be sent to the stations, since the last call.
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

// A target with a position that counts, as the fusion has sent it; nullopt: it is none.
std::optional<WatchedTarget> watched(const TargetHeard& target);

}  // namespace ols::console
