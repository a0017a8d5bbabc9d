#include "console/incidents/incident_book.h"

#include <algorithm>
#include <stdexcept>

#include "conditions/alarms.h"
#include "conditions/sayings.h"
#include "geometry/angles.h"

namespace ols::console {
namespace {

constexpr std::int64_t kPictureBefore_us = 1'000'000;  // an older one shows something else

std::string id_of(const ReceivedTarget& target) {
  return std::to_string(target.boot_id) + "/" + target.id;
}

// ee, en, eu, nn, nu, uu; not finite where there is none.
Eigen::Matrix3d covariance_of(const Json& fields) {
  const auto at = [&](std::size_t i) {
    const Json* list =
        fields.contains("covariance_enu_m2") ? &fields["covariance_enu_m2"] : nullptr;
    const bool is_known = list != nullptr && list->size() == 6 && (*list)[i].is_number();
    return is_known ? (*list)[i].get<double>() : wire::kNaN;
  };
  Eigen::Matrix3d covariance;
  covariance << at(0), at(1), at(2), at(1), at(3), at(4), at(2), at(4), at(5);
  return covariance;
}

std::string sentence(const Incident& incident) {
  return incident.object_class == "unknown" ? "target" : incident.object_class;
}

}  // namespace

// Tentative targets are not watched: they may not exist.
std::optional<WatchedTarget> watched(const ReceivedTarget& target) {
  const Json& fields = target.fields;
  if (target.what != ReceivedTarget::What::kPosition || fields.value("state", "") == "tentative") {
    return std::nullopt;
  }
  WatchedTarget result;
  result.id = id_of(target);
  result.utime_us = fields.value("utime_us", std::int64_t{0});
  result.position = {radians(target.latitude_deg), radians(target.longitude_deg), target.height_m};
  result.covariance_enu_m2 = covariance_of(fields);
  result.object_class = fields.value("class", "unknown");
  const Json probability = fields.value("class_probability", Json(nullptr));
  if (probability.is_number()) result.class_probability = probability.get<double>();
  for (const Json& station : fields.value("stations", Json::array())) {
    if (station.at("used").get<bool>()) result.stations.push_back(station.at("id"));
  }
  return result;
}

void IncidentBook::resume(KeptIncidents kept, double now_s) {
  may_change_areas_ = kept.may_change_areas;
  pictures_ = std::move(kept.pictures);
  watch_.resume(std::move(kept.areas), std::move(kept.incidents), kept.numbers, now_s);
}

void IncidentBook::receive(const ReceivedTarget& target, int minute_of_day, double now_s) {
  if (target.what == ReceivedTarget::What::kDropped) return watch_.drop(id_of(target));
  if (const auto one = watched(target)) watch_.receive(*one, minute_of_day, now_s);
}

void IncidentBook::turn(double now_s,
                        const std::function<const Picture*(const std::string&)>& newest) {
  watch_.turn(now_s);
  IncidentWatch::Changes changes = watch_.take_changes();
  for (const std::uint64_t number : changes.entered) {
    const auto incident = watch_.incidents().find(number);
    if (incident == watch_.incidents().end() || incident->second.entries > 1) continue;
    if (recording_.before_s + recording_.after_s <= 0.0) continue;
    for (const std::string& station : incident->second.stations) {
      wire::Order order{.station = station, .kind = wire::Kind::kRecord};
      order.before_s = recording_.before_s;
      order.after_s = recording_.after_s;
      order.label = "incident-" + std::to_string(number);
      recordings_.push_back(std::move(order));
    }
  }
  add_pictures(newest);
  news_.incidents.merge(changes.changed);
  for (const std::uint64_t number : changes.forgotten) {
    pictures_.erase(number);
    news_.forgotten.push_back(number);
  }
}

// An incident begins without a picture, and gets the next one of its stations.
void IncidentBook::add_pictures(const std::function<const Picture*(const std::string&)>& newest) {
  for (const auto& [number, incident] : watch_.incidents()) {
    if (!incident.is_inside() || !incident.picture.is_null()) continue;
    for (const std::string& station : incident.stations) {
      const Picture* picture = newest(station);
      if (picture == nullptr || picture->bytes.size() > kMostPictureBytes) continue;
      const auto field = [&](const char* key) { return picture->header.value(key, Json(nullptr)); };
      const Json utime_us = field("utime_us");
      if (!utime_us.is_number() || utime_us < incident.begun_us - kPictureBefore_us) continue;
      pictures_[number] = picture->bytes;
      news_.pictures.insert(number);
      news_.incidents.insert(number);
      watch_.set_picture(number, {{"station", station},
                                  {"utime_us", utime_us},
                                  {"full_px", field("full_px")},
                                  {"box_px", field("box_px")}});
      break;
    }
  }
}

Outcome IncidentBook::change(const AreaChange& change) {
  if (!may_change_areas_) return outcome::areas_unreadable();
  if (change.area.is_null()) {
    if (!watch_.remove(change.name)) return outcome::no_such_area();
  } else {
    try {
      if (!watch_.set(area_from(change.area))) return outcome::too_many_areas();
    } catch (const std::invalid_argument& error) {
      return outcome::area_is_wrong(error.what());
    }
  }
  news_.areas = true;
  return {};
}

Outcome IncidentBook::judge(const IncidentJudgement& verdict, const std::string& who,
                            std::int64_t utime_us) {
  if (watch_.judge(verdict.incident, verdict.verdict, who, utime_us)) return {};
  return outcome::no_such_incident();
}

std::vector<Alarm> IncidentBook::alarms() const {
  std::vector<Alarm> alarms;
  for (const auto& [number, incident] : watch_.incidents()) {
    if (!incident.is_alarm()) continue;
    alarms.push_back(alarm::area_entered(incident.area, sentence(incident),
                                         std::string(incident.target_number())));
  }
  return alarms;
}

const std::string* IncidentBook::picture(std::uint64_t incident) const {
  const auto found = pictures_.find(incident);
  return found == pictures_.end() ? nullptr : &found->second;
}

IncidentBook::News IncidentBook::take_news() { return std::exchange(news_, {}); }

}  // namespace ols::console
