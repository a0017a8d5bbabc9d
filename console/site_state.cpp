#include "console/site_state.h"

#include <algorithm>
#include <utility>

#include "conditions/alarms.h"
#include "conditions/sayings.h"

namespace ols::console {
namespace {

constexpr double kForgetStation_s = 900.0;
constexpr double kForgetTarget_s = 20.0;
constexpr double kLineStale_s = 1.5, kForgetLine_s = 5.0;
constexpr double kFusionStale_s = 5.0;  // it reports each second, or as often as configured
constexpr double kTrailPeriod_s = 0.4;
constexpr const char* kFusion = "fusion";

}  // namespace

void SiteState::note_alarms(AlarmChanges& known, const std::string& station,
                            const std::vector<Alarm>& alarms, std::int64_t utime_us) {
  const std::vector<Alarm> first(
      alarms.begin(), alarms.begin() + std::min(alarms.size(), std::size_t{kMostAlarms}));
  for (const AlarmChanges::Change& change : known.look(first)) {
    if (change.begins) {
      note_alarm(station, change.alarm, utime_us);
    } else {
      events_.end(station, change.key, utime_us, revision_);
    }
  }
}

void SiteState::note_error(const std::string& station, const std::string& error,
                           std::int64_t error_utime_us, std::int64_t utime_us) {
  Kept& kept = kept_[station];
  if (kept.last_error == error && kept.last_error_utime_us == error_utime_us) return;
  kept.last_error = error;
  kept.last_error_utime_us = error_utime_us;
  if (!error.empty()) note({utime_us, "error", station, "", error, ""});
}

void SiteState::receive(const ReceivedStation& station, const Now& now) {
  if (!stations_.set(station.id, station.fields, now.monotonic_s, revision_)) {
    ++refused_;
    return;
  }
  events_.end(station.id, alarm::station_silent().key(), now.utime_us, revision_);
  note_alarms(kept_[station.id].alarms, station.id, station.alarms, now.utime_us);
  note_error(station.id, station.last_error, station.last_error_utime_us, now.utime_us);
}

void SiteState::receive_bearing(const std::string& station, const Json& bearing) {
  stations_.mark(station, "bearing", bearing, revision_);
}

void SiteState::receive_own(const std::vector<Alarm>& alarms, const Now& now) {
  note_alarms(own_, "", alarms, now.utime_us);
}

bool SiteState::name_target(const std::string& id, const std::string& name) {
  if (!targets_.find(id)) return false;
  targets_.mark(id, "name", name, revision_);
  return true;
}

void SiteState::set_holder(const std::string& station, const Json& holder) {
  stations_.mark(station, "control", holder, revision_);
}

void SiteState::set_procedure(const std::string& station, const Json& procedure) {
  stations_.mark(station, "procedure", procedure, revision_);
}

void SiteState::set_areas(const Json& areas) {
  for (const std::string& name : areas_.ids()) {
    const auto is_it = [&](const Json& area) { return area.at("name") == name; };
    if (std::ranges::none_of(areas, is_it)) areas_.remove(name, revision_);
  }
  for (const Json& area : areas) areas_.set(area.at("name"), area, 0.0, revision_);
}

void SiteState::set_incident(std::uint64_t number, const Json& incident) {
  const std::string id = std::to_string(number);
  if (incident.is_null()) return incidents_.remove(id, revision_);
  incidents_.set(id, incident, 0.0, revision_);
}

// The ids of another fusion process mean other objects. A process that appears while the known
// fusion is still heard is a second or a forged one, and no restarted fusion.
bool SiteState::is_of_fusion(std::int64_t boot_id, const Now& now) {
  const bool is_heard = now.monotonic_s < fusion_heard_s_ + kFusionGone_s;
  if (boot_id != fusion_boot_ && fusion_boot_ != 0 && is_heard) return false;
  fusion_heard_s_ = now.monotonic_s;
  if (boot_id == fusion_boot_) return true;
  if (fusion_boot_ != 0) note(noted(now.utime_us, "site", "", "", note::fusion_restarted()));
  fusion_boot_ = boot_id;
  targets_.clear(revision_);
  lines_.clear(revision_);
  trails_.clear();
  occluded_.clear();
  return true;
}

void SiteState::receive(const ReceivedOcclusion& occlusion, const Now& now) {
  if (!stations_.find(occlusion.station)) return;
  if (!occlusion.is_hidden || !(occlusion.holds_s > 0.0)) {
    occluded_.erase(occlusion.station);
    return;
  }
  const auto known = occluded_.find(occlusion.station);
  const bool goes_on = known != occluded_.end() && known->second.target == occlusion.target &&
                       now.monotonic_s < known->second.until_s;
  occluded_[occlusion.station] = {occlusion.target,
                                  goes_on ? known->second.since_us : occlusion.utime_us,
                                  occlusion.back_us, now.monotonic_s + occlusion.holds_s};
}

Json SiteState::hidden(const std::string& target, double now_s) const {
  constexpr double kSeen_s = 1.0;
  Json from = Json::array();
  const auto hides = [&](const auto& one) {
    return one.second.target == target && now_s <= one.second.until_s;
  };
  for (const auto& one : occluded_) {
    if (!hides(one)) continue;
    const auto& [station, occluded] = one;
    from.push_back(
        {{"id", station}, {"since_us", occluded.since_us}, {"back_us", occluded.back_us}});
  }
  const Json* fields = targets_.find(target);
  if (from.empty() || !fields) return nullptr;
  const auto sees = [&](const Json& station) {
    const auto known = occluded_.find(station.at("id").get<std::string>());
    const bool is_recent = station.at("age_s").is_number() && station.at("age_s") < kSeen_s;
    return station.at("used") && is_recent && !(known != occluded_.end() && hides(*known));
  };
  const bool is_seen = std::ranges::any_of(fields->value("stations", Json::array()), sees);
  return {{"from", std::move(from)}, {"all", !is_seen}};
}

void SiteState::add_to_trail(const ReceivedTarget& target, double now_s) {
  Trail& trail = trails_[target.id];
  if (now_s < trail.added_s + kTrailPeriod_s) return;
  const bool was_unseen = now_s > trail.added_s + kTargetStale_s;
  if (was_unseen && !trail.points.empty()) trail.points.emplace_back(nullptr);
  trail.added_s = now_s;
  Json point{target.longitude_deg, target.latitude_deg, target.height_m};
  if (const Json hides = hidden(target.id, now_s); !hides.is_null()) {
    Json& from = point.emplace_back(Json::array());
    for (const Json& one : hides.at("from")) from.push_back(one.at("id"));
    if (hides.at("all")) from.push_back("*");
  }
  trail.points.push_back(std::move(point));
  while (trail.points.size() > kMostTrailPoints) trail.points.pop_front();
}

void SiteState::receive(const ReceivedTarget& target, const Now& now) {
  using What = ReceivedTarget::What;
  if (!is_of_fusion(target.boot_id, now)) return;
  switch (target.what) {
    case What::kPosition:
      if (!targets_.set(target.id, target.fields, now.monotonic_s, revision_)) {
        ++refused_;
        return;
      }
      targets_.mark(target.id, "hidden", hidden(target.id, now.monotonic_s), revision_);
      add_to_trail(target, now.monotonic_s);
      return;
    case What::kLine:
      if (!lines_.set(target.id, target.fields, now.monotonic_s, revision_)) ++refused_;
      return;
    case What::kNoPosition:
      if (!targets_.find(target.id)) return;
      for (const auto& [field, value] : target.fields.items()) {
        if (field == "utime_us") continue;  // it is that of the position
        targets_.mark(target.id, field, value, revision_);
      }
      return;
    case What::kDropped:
      targets_.remove(target.id, revision_);
      trails_.erase(target.id);
      return;
    case What::kNothing:
      return;
  }
}

void SiteState::receive(const ReceivedFusion& fusion, const Now& now) {
  if (!is_of_fusion(fusion.boot_id, now)) return;
  fusion_.set(kFusion, fusion.fields, now.monotonic_s, revision_);
  events_.end("", alarm::fusion_silent().key(), now.utime_us, revision_);
  note_alarms(kept_[""].alarms, "", fusion.alarms, now.utime_us);
  note_error("", fusion.last_error, 0, now.utime_us);
}

void SiteState::look(const Now& now) {
  const double now_s = now.monotonic_s;
  for (const auto& id : stations_.age(now_s, kStationStale_s, kForgetStation_s, revision_)) {
    note_alarm(id, alarm::station_silent(), now.utime_us);
  }
  if (!fusion_.age(now_s, kFusionStale_s, kForgetStation_s, revision_).empty()) {
    note_alarm("", alarm::fusion_silent(), now.utime_us);
  }
  targets_.age(now_s, kTargetStale_s, kForgetTarget_s, revision_);
  for (const std::string& id : targets_.ids()) {
    targets_.mark(id, "hidden", hidden(id, now_s), revision_);
  }
  lines_.age(now_s, kLineStale_s, kForgetLine_s, revision_);
  std::erase_if(occluded_, [&](const auto& o) { return now_s > o.second.until_s; });
  std::erase_if(trails_, [this](const auto& t) { return targets_.find(t.first) == nullptr; });
  std::erase_if(kept_, [&](const auto& k) {
    if (k.first.empty() || stations_.find(k.first) != nullptr) return false;
    events_.end_all(k.first, now.utime_us, revision_);
    return true;
  });
}

Json SiteState::counts() const {
  return {{"stations", stations_.size()},
          {"stations_silent", stations_.stale()},
          {"targets", targets_.size()},
          {"fusion", fusion_.size() > fusion_.stale()}};
}

Json SiteState::snapshot() const {
  Json targets = targets_.all();
  for (Json& target : targets) {
    const auto trail = trails_.find(target.at("id").get<std::string>());
    target["trail"] = trail == trails_.end() ? Json::array() : Json(trail->second.points);
  }
  const Json* fusion = fusion_.find(kFusion);
  return {{"kind", "snapshot"},          {"revision", revision_},
          {"stations", stations_.all()}, {"targets", std::move(targets)},
          {"lines", lines_.all()},       {"fusion", fusion ? *fusion : Json(nullptr)},
          {"areas", areas_.all()},       {"incidents", incidents_.all()},
          {"events", events_.since(0)}};
}

Json SiteState::changes(Revision since) const {
  auto stations = stations_.gone(since), targets = targets_.gone(since), lines = lines_.gone(since);
  auto areas = areas_.gone(since), incidents = incidents_.gone(since);
  if (!stations || !targets || !lines || !areas || !incidents) return snapshot();
  Json result{{"kind", "delta"}, {"revision", revision_}};
  const auto add = [&result](const char* name, Json part) {
    if (!part.empty()) result[name] = std::move(part);
  };
  add("stations", stations_.changed(since));
  add("targets", targets_.changed(since));
  add("lines", lines_.changed(since));
  add("areas", areas_.changed(since));
  add("incidents", incidents_.changed(since));
  add("events", events_.since(since));
  const Json fusion = fusion_.changed(since);
  if (!fusion.empty()) result["fusion"] = fusion.front();
  Json gone = Json::object();
  if (!stations->empty()) gone["stations"] = *stations;
  if (!targets->empty()) gone["targets"] = *targets;
  if (!lines->empty()) gone["lines"] = *lines;
  if (!areas->empty()) gone["areas"] = *areas;
  if (!incidents->empty()) gone["incidents"] = *incidents;
  add("gone", std::move(gone));
  return result;
}

}  // namespace ols::console
