#include "console/incidents/incident_watch.h"

#include <algorithm>
#include <utility>

#include "geometry/angles.h"

namespace ols::console {

void IncidentWatch::resume(std::vector<Area> areas, std::vector<Incident> incidents,
                           std::uint64_t numbers, double now_s) {
  areas_ = std::move(areas);
  numbers_ = numbers;
  for (Incident& incident : incidents) {
    const std::int64_t last_us =
        incident.track.empty() ? incident.begun_us : incident.track.back().utime_us;
    const bool has_area = std::ranges::find(areas_, incident.area, &Area::name) != areas_.end();
    if (incident.is_inside() && !has_area) end(incident, last_us);
    if (incident.is_inside()) heard_[incident.target] = {now_s, last_us};
    incidents_[incident.number] = std::move(incident);
  }
}

bool IncidentWatch::set(const Area& area) {
  const auto known = std::ranges::find(areas_, area.name, &Area::name);
  if (known != areas_.end()) {
    *known = area;
    return true;
  }
  if (areas_.size() >= kMostAreas) return false;
  areas_.push_back(area);
  return true;
}

bool IncidentWatch::remove(const std::string& area) {
  if (std::erase_if(areas_, [&](const Area& a) { return a.name == area; }) == 0) return false;
  for (auto& [number, incident] : incidents_) {
    if (incident.area == area && incident.is_inside()) {
      end(incident, heard_[incident.target].utime_us);
    }
  }
  return true;
}

Incident* IncidentWatch::incident_of(const std::string& target, const std::string& area) {
  const auto found = std::ranges::find_if(incidents_, [&](const auto& entry) {
    return entry.second.target == target && entry.second.area == area;
  });
  return found == incidents_.end() ? nullptr : &found->second;
}

bool IncidentWatch::is_dismissed(const std::string& target) const {
  return std::ranges::any_of(incidents_, [&](const auto& entry) {
    return entry.second.target == target && entry.second.verdict == Judgement::kDismissed;
  });
}

void IncidentWatch::hear(const WatchedTarget& target, int minute_of_day, double now_s) {
  if (areas_.empty()) return;
  bool is_inside = false;
  for (const Area& area : areas_) {
    Incident* incident = incident_of(target.id, area.name);
    const bool was_inside = incident != nullptr && incident->is_inside();
    const bool may_enter = is_watched(area, minute_of_day) && concerns(area, target.object_class);
    if (!was_inside && !may_enter) continue;
    const double probability = probability_inside(area, target.position, target.covariance_enu_m2);
    if (was_inside && probability < kLeaves) {
      end(*incident, target.utime_us);
    } else if (was_inside) {
      stay(target, *incident);
      is_inside = true;
    } else if (probability >= kEnters && !is_dismissed(target.id)) {
      enter(target, area);
      is_inside = true;
    }
  }
  if (is_inside) {
    heard_[target.id] = {now_s, target.utime_us};
  } else {
    heard_.erase(target.id);
  }
}

void IncidentWatch::enter(const WatchedTarget& target, const Area& area) {
  Incident* incident = incident_of(target.id, area.name);
  if (incident != nullptr) {
    ++incident->entries;
    incident->ended_us = 0;
  } else {
    if (incidents_.size() >= kMostIncidents) forget_oldest();
    incident = &incidents_[++numbers_];
    incident->number = numbers_;
    incident->area = area.name;
    incident->target = target.id;
    incident->begun_us = target.utime_us;
  }
  incident->stations = target.stations;
  changes_.entered.push_back(incident->number);
  changes_.changed.insert(incident->number);
  stay(target, *incident);
}

void IncidentWatch::stay(const WatchedTarget& target, Incident& incident) {
  add_to_track({target.utime_us, degrees(target.position.longitude_rad),
                degrees(target.position.latitude_rad), target.position.height_m},
               incident);
  if (incident.object_class != target.object_class) changes_.changed.insert(incident.number);
  incident.object_class = target.object_class;
  incident.class_probability = target.class_probability;
}

void IncidentWatch::end(Incident& incident, std::int64_t utime_us) {
  incident.ended_us = utime_us;
  changes_.changed.insert(incident.number);
}

void IncidentWatch::drop(const std::string& target) {
  const auto heard = heard_.find(target);
  if (heard == heard_.end()) return;
  for (auto& [number, incident] : incidents_) {
    if (incident.target == target && incident.is_inside()) end(incident, heard->second.utime_us);
  }
  heard_.erase(heard);
}

void IncidentWatch::turn(double now_s) {
  std::vector<std::string> lost;
  for (const auto& [target, heard] : heard_) {
    if (now_s > heard.now_s + kLost_s) lost.push_back(target);
  }
  for (const std::string& target : lost) drop(target);
}

bool IncidentWatch::judge(std::uint64_t number, Judgement verdict, const std::string& who,
                          std::int64_t utime_us) {
  const auto found = incidents_.find(number);
  if (found == incidents_.end()) return false;
  const std::string target = found->second.target;
  for (auto& [of_number, incident] : incidents_) {
    if (incident.target != target) continue;
    incident.verdict = verdict;
    incident.judged_by = who;
    incident.judged_us = utime_us;
    changes_.changed.insert(of_number);
  }
  return true;
}

void IncidentWatch::set_picture(std::uint64_t number, const nlohmann::json& picture) {
  const auto found = incidents_.find(number);
  if (found == incidents_.end()) return;
  found->second.picture = picture;
  changes_.changed.insert(number);
}

// Not one that lasts, while there is another.
void IncidentWatch::forget_oldest() {
  auto oldest = std::ranges::find_if_not(
      incidents_, [](const auto& entry) { return entry.second.is_inside(); });
  if (oldest == incidents_.end()) oldest = incidents_.begin();
  changes_.forgotten.push_back(oldest->first);
  incidents_.erase(oldest);
}

}  // namespace ols::console
