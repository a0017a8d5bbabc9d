// Judges which targets are in which areas, and keeps the incidents. Pure.
//
// An incident begins when the probability that a target is in an area reaches kEnters, and the
// target is inside until it has been below kLeaves for kLeaves_s: between them an uncertain target
// changes nothing, and one that hovers at the border does not ring again and again (measured in
// docs/events.md). A position without a proper covariance says only that the target is still there.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "console/incidents/area.h"
#include "console/incidents/incident.h"

namespace ols::console {

// A target with a position.
struct WatchedTarget {
  std::int64_t utime_us = 0;
  std::string id;  // "BOOT/NUMBER", as in Incident
  Geodetic position;
  Eigen::Matrix3d covariance_enu_m2 = Eigen::Matrix3d::Zero();
  std::string object_class = "unknown";
  double class_probability = 0.0;
  std::vector<std::string> stations;  // whose bearings it is made of
};

class IncidentWatch {
 public:
  // What was kept, and the highest number that was given before. Incidents of targets that are not
  // heard again end.
  void resume(std::vector<Area> areas, std::vector<Incident> incidents, std::uint64_t numbers,
              double now_s);

  // Adds the area, or replaces the one of its name. Incidents go on. False: there are kMostAreas.
  bool set(const Area& area);
  // Incidents in it end. False: there is no such area.
  bool remove(const std::string& area);
  const std::vector<Area>& areas() const { return areas_; }

  // `minute_of_day`: local. Areas whose time it is not begin no incident; one that has begun lasts.
  void hear(const WatchedTarget& target, int minute_of_day, double now_s);
  // The target is no more.
  void drop(const std::string& target);
  // Call often: a target that was not heard for kLost_s is lost. `now_s`: monotonic.
  void turn(double now_s);

  // What a person says of an incident's target: it holds for all its incidents. A dismissed target
  // begins no other, in no area, also when its incidents are forgotten: until it is dropped. False:
  // there is no such incident.
  bool judge(std::uint64_t number, Judgement verdict, const std::string& who,
             std::int64_t utime_us);
  // A picture was kept with the incident; as Incident::picture.
  void set_picture(std::uint64_t number, const nlohmann::json& picture);

  const std::map<std::uint64_t, Incident>& incidents() const { return incidents_; }

  // What has happened since the last call.
  struct Changes {
    std::vector<std::uint64_t> entered;    // a target came in, for the first time or again
    std::set<std::uint64_t> changed;       // in whatever way but its track
    std::vector<std::uint64_t> forgotten;  // to make room
  };
  Changes take_changes() { return std::exchange(changes_, {}); }

  static constexpr double kEnters = 0.95, kLeaves = 0.05;
  static constexpr double kLeaves_s = 5.0, kLost_s = 20.0;
  static constexpr std::size_t kMostAreas = 50, kMostIncidents = 200, kMostDismissed = 1000;

 private:
  Incident* incident_of(const std::string& target, const std::string& area);
  bool is_dismissed(const std::string& target) const;
  Incident& enter(const WatchedTarget& target, const Area& area);
  void stay(const WatchedTarget& target, Incident& incident);
  bool has_left(const Incident& incident, double now_s);
  void end(Incident& incident);
  void lose(const std::string& target);
  void forget_one();

  std::vector<Area> areas_;
  std::map<std::uint64_t, Incident> incidents_;
  std::uint64_t numbers_ = 0;
  std::map<std::string, double> heard_s_;  // targets that are inside: when they were heard
  std::map<std::uint64_t, double> outside_since_s_;  // incidents whose targets may have left
  std::deque<std::string> dismissed_;                // targets whose incidents are forgotten
  Changes changes_;
};

}  // namespace ols::console
