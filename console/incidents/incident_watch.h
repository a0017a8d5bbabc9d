// Decides which targets are in which areas, and keeps the incidents. Pure.
//
// An incident begins when the probability that a target is in an area reaches kEnters. The target
// is inside until the probability has been below kLeaves for kLeaves_s. So an uncertain target
// changes nothing, and one at the border raises no series of alarms (measured in docs/events.md). A
// position without a proper covariance shows only that the target still exists.
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
  std::vector<std::string> stations;  // whose bearings determine the position
};

class IncidentWatch {
 public:
  // Takes what was kept, and the highest number used before. Incidents end if their targets are not
  // heard again.
  void resume(std::vector<Area> areas, std::vector<Incident> incidents, std::uint64_t numbers,
              double now_s);

  // Adds the area, or replaces the one with its name. Incidents continue. False: there are already
  // kMostAreas.
  bool set(const Area& area);
  // Removes the area, and ends the incidents in it. False: there is no such area.
  bool remove(const std::string& area);
  const std::vector<Area>& areas() const { return areas_; }

  // `minute_of_day`: in the time zone of this host. Outside of an area's hours no incident begins
  // in it; one that has begun continues.
  void receive(const WatchedTarget& target, int minute_of_day, double now_s);
  // The target no longer exists.
  void drop(const std::string& target);
  // Call often: a target that was not heard for kLost_s counts as lost. `now_s`: monotonic.
  void turn(double now_s);

  // A person judges an incident. The judgement holds for all incidents of its target. A dismissed
  // target begins no other incident in any area until it is dropped, even when its incidents are
  // forgotten. False: there is no such incident.
  bool judge(std::uint64_t number, Judgement verdict, const std::string& who,
             std::int64_t utime_us);
  // A picture was stored with the incident. `picture`: as Incident::picture.
  void set_picture(std::uint64_t number, const nlohmann::json& picture);

  const std::map<std::uint64_t, Incident>& incidents() const { return incidents_; }

  // What has happened since the last call.
  struct Changes {
    std::vector<std::uint64_t> entered;    // a target came in, for the first time or again
    std::set<std::uint64_t> changed;       // in any way except its track
    std::vector<std::uint64_t> forgotten;  // removed to make room
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
  std::map<std::string, double> heard_s_;  // targets that are inside, with the time when each was
                                           // last heard
  std::map<std::uint64_t, double> outside_since_s_;  // incidents whose targets may have left
  std::deque<std::string> dismissed_;                // targets whose incidents are forgotten
  Changes changes_;
};

}  // namespace ols::console
