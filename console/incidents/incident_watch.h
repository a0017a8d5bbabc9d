// Decides which targets are in which areas, and keeps the list of incidents. Pure.
//
// An incident begins when the probability that a target is in an area reaches kEnters. The target
// stays inside until the probability has been below kLeaves for kLeaves_s. Therefore, a target with
// a large error neither enters nor leaves, and a target at the border does not raise one alarm
// after another (measured in docs/events.md). A position without a valid covariance shows only that
// the target still exists.
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
  std::vector<std::string> stations;  // stations whose bearings determine the position
};

class IncidentWatch {
 public:
  // Restores areas and incidents. `numbers`: the highest number used before. An incident whose
  // target was inside ends after kLost_s if the target does not appear again.
  void resume(std::vector<Area> areas, std::vector<Incident> incidents, std::uint64_t numbers,
              double now_s);

  // Adds the area, or replaces the area of the same name; its incidents continue. False: there are
  // already kMostAreas areas.
  bool set(const Area& area);
  // Removes the area, and ends the incidents in it. False: there is no such area.
  bool remove(const std::string& area);
  const std::vector<Area>& areas() const { return areas_; }

  // Takes a target's newest position. `minute_of_day`: in the time zone of this host. Outside an
  // area's hours, no incident begins in the area; an incident that has begun continues.
  void receive(const WatchedTarget& target, int minute_of_day, double now_s);
  // Call when the target no longer exists.
  void drop(const std::string& target);
  // Call often: ends the incidents of targets that were not received for kLost_s. `now_s`:
  // monotonic.
  void turn(double now_s);

  // A person judges an incident. The judgement holds for all incidents of the same target. A
  // dismissed target begins no incident in any area until drop(), even when its incidents are
  // forgotten. False: there is no such incident.
  bool judge(std::uint64_t number, Judgement verdict, const std::string& who,
             std::int64_t utime_us);
  // Notes that the incident has a picture. `picture`: as Incident::picture.
  void set_picture(std::uint64_t number, const nlohmann::json& picture);

  const std::map<std::uint64_t, Incident>& incidents() const { return incidents_; }

  // What has happened since the last call.
  struct Changes {
    std::vector<std::uint64_t> entered;    // incidents whose target came in, for the first time or
                                           // again
    std::set<std::uint64_t> changed;       // incidents changed in any way except the track
    std::vector<std::uint64_t> forgotten;  // incidents removed to make room
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
  std::map<std::string, double> heard_s_;  // targets that are inside, each with the time when it
                                           // was last received
  std::map<std::uint64_t, double> outside_since_s_;  // incidents whose targets may have left, each
                                                     // with the time when this began
  std::deque<std::string> dismissed_;                // targets whose incidents are forgotten
  Changes changes_;
};

}  // namespace ols::console
