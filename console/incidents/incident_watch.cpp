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
    const bool has_area = std::ranges::find(areas_, incident.area, &Area::name) != areas_.end();
    if (incident.is_inside() && !has_area) end(incident);
    if (incident.is_inside()) heard_s_[incident.target] = now_s;
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
    if (incident.area == area && incident.is_inside()) end(incident);
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
  const auto is_of_it = [&](const auto& entry) {
    return entry.second.target == target && entry.second.verdict == Judgement::kDismissed;
  };
  return std::ranges::find(dismissed_, target) != dismissed_.end() ||
         std::ranges::any_of(incidents_, is_of_it);
}

void IncidentWatch::receive(const WatchedTarget& target, int minute_of_day, double now_s) {
  if (areas_.empty()) return;
  bool is_inside = false;
  for (const Area& area : areas_) {
    Incident* incident = incident_of(target.id, area.name);
    const bool was_inside = incident != nullptr && incident->is_inside();
    const bool may_enter = is_watched(area, minute_of_day) && concerns(area, target.object_class);
    if (!was_inside && !may_enter) continue;
    const auto probability = probability_inside(area, target.position, target.covariance_enu_m2);
    if (was_inside && probability) {
      if (*probability >= kLeaves) {
        stay(target, *incident);
      } else if (has_left(*incident, now_s)) {
        end(*incident);
      }
    } else if (!was_inside && probability >= kEnters && !is_dismissed(target.id)) {
      incident = &enter(target, area);
    }
    is_inside = is_inside || (incident != nullptr && incident->is_inside());
  }
  if (is_inside) {
    heard_s_[target.id] = now_s;
  } else {
    heard_s_.erase(target.id);
  }
}

bool IncidentWatch::has_left(const Incident& incident, double now_s) {
  return now_s >= outside_since_s_.try_emplace(incident.number, now_s).first->second + kLeaves_s;
}

Incident& IncidentWatch::enter(const WatchedTarget& target, const Area& area) {
  Incident* incident = incident_of(target.id, area.name);
  if (incident != nullptr) {
    ++incident->entries;
    incident->ended_us = 0;
  } else {
    if (incidents_.size() >= kMostIncidents) forget_one();
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
  return *incident;
}

void IncidentWatch::stay(const WatchedTarget& target, Incident& incident) {
  outside_since_s_.erase(incident.number);
  incident.last = {target.utime_us, degrees(target.position.longitude_rad),
                   degrees(target.position.latitude_rad), target.position.height_m};
  add_to_track(incident.last, incident);
  if (incident.object_class != target.object_class) changes_.changed.insert(incident.number);
  incident.object_class = target.object_class;
  incident.class_probability = target.class_probability;
}

void IncidentWatch::end(Incident& incident) {
  incident.ended_us = incident.last.utime_us;
  outside_since_s_.erase(incident.number);
  changes_.changed.insert(incident.number);
}

void IncidentWatch::drop(const std::string& target) {
  std::erase(dismissed_, target);
  lose(target);
}

void IncidentWatch::lose(const std::string& target) {
  if (heard_s_.erase(target) == 0) return;
  for (auto& [number, incident] : incidents_) {
    if (incident.target == target && incident.is_inside()) end(incident);
  }
}

void IncidentWatch::turn(double now_s) {
  std::vector<std::string> lost;
  for (const auto& [target, heard_s] : heard_s_) {
    if (now_s > heard_s + kLost_s) lost.push_back(target);
  }
  for (const std::string& target : lost) lose(target);
}

bool IncidentWatch::judge(std::uint64_t number, Judgement verdict, const std::string& who,
                          std::int64_t utime_us) {
  const auto found = incidents_.find(number);
  if (found == incidents_.end()) return false;
  const std::string target = found->second.target;
  std::erase(dismissed_, target);
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

// Forgets the oldest of those that matter least: those that are over before the others, and of
// these the dismissed, then the confirmed ones.
void IncidentWatch::forget_one() {
  const auto worth = [](const auto& entry) {
    const Incident& incident = entry.second;
    const int verdict = incident.verdict == Judgement::kDismissed   ? 0
                        : incident.verdict == Judgement::kConfirmed ? 1
                                                                    : 2;
    return std::pair(incident.is_inside(), verdict);
  };
  const auto least = std::ranges::min_element(incidents_, {}, worth);
  if (is_dismissed(least->second.target)) {
    std::erase(dismissed_, least->second.target);
    dismissed_.push_back(least->second.target);
    if (dismissed_.size() > kMostDismissed) dismissed_.pop_front();
  }
  outside_since_s_.erase(least->first);
  changes_.forgotten.push_back(least->first);
  incidents_.erase(least);
}

}  // namespace ols::console
