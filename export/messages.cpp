#include "export/messages.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/bus/channel_names.h"
#include "base/bus/message_code.h"
#include "base/text/plain_text.h"
#include "export/identity.h"
#include "geometry/angles.h"
#include "geometry/wgs84.h"
#include "ols_msg/bearing_t.hpp"
#include "ols_msg/incident_t.hpp"
#include "ols_msg/station_status_t.hpp"
#include "ols_msg/target_t.hpp"
#include "wire/read.h"
#include "wire/station_status.h"
#include "wire/target.h"

namespace ols::exports {
namespace {

using Bearing = ols_msg::bearing_t;
using IncidentMessage = ols_msg::incident_t;
using Status = ols_msg::station_status_t;
using TargetMessage = ols_msg::target_t;

static_assert(code(TrackState::kEnded) == TargetMessage::TRACK_DROPPED);
static_assert(code(ObjectClass::kOther) == TargetMessage::CLASS_OTHER);

constexpr std::size_t kMostStations = 64;  // named with a target
constexpr double kMostEarth_m = 1e8;       // of an ECEF component

Place place_of(double latitude_deg, double longitude_deg, double height_m,
               const SiteContext& site) {
  const double longitude = degrees(wrap_pi(radians(longitude_deg)));
  return {latitude_deg, longitude, height_m, site.geoid_m(latitude_deg, longitude)};
}

void add_appearance(const TargetMessage& t, Target& target) {
  const auto known = [](double value) { return value > 0.0 ? value : kUnknown; };
  target.object_class = wire::object_class_of(t.object_class);
  target.class_probability = std::min(known(t.class_probability), 1.0);
  target.size_m = known(t.size_m);
  target.size_sd_m = known(t.size_sd_m);
  if (t.has_height_above_ground) {
    target.above_ground_m = t.height_above_ground_m;
    target.above_ground_sd_m = t.height_above_ground_sd_m;
  }
}

std::vector<std::string> used_stations(const TargetMessage& t) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(t.station.size(), kMostStations); ++i) {
    if (t.used[i] != 0) names.push_back(t.station[i]);
  }
  return names;
}

}  // namespace

std::optional<Target> target_from(const BusMessage& message, const SiteContext& site) {
  const auto content = wire::decode_target(message);
  if (!content || content->target_id == 0) return std::nullopt;
  const TargetMessage& t = *content;
  Target target;
  target.utime_us = t.utime;
  target.id = t.target_id;
  target.uid = target_uid(site.site, t.boot_id, t.target_id);
  target.state = from_code(t.track_state, TrackState::kEnded, TrackState::kConfirmed);
  if (target.state == TrackState::kEnded) {
    target.place = {kUnknown, kUnknown, kUnknown, kUnknown};
    target.velocity_enu_m_s.fill(kUnknown);
    return target;
  }
  if (!wire::has_position(t)) return std::nullopt;
  target.place = place_of(t.latitude_deg, t.longitude_deg, t.height_m, site);
  std::ranges::copy(t.position_covariance_enu_m2, target.covariance_m2.begin());
  std::ranges::copy(t.velocity_covariance_enu_m2_s2, target.velocity_covariance_m2_s2.begin());
  Eigen::Vector3d::Map(target.velocity_enu_m_s.data()) = wire::velocity_enu(t);
  target.stations = used_stations(t);
  add_appearance(t, target);
  return target;
}

std::optional<Station> station_from(const BusMessage& message, const SiteContext& site) {
  const auto content = wire::decode_status(message);
  if (!content ||
      !wire::is_place(content->latitude_deg, content->longitude_deg, content->height_m)) {
    return std::nullopt;
  }
  const Status& s = *content;
  Station station;
  station.utime_us = s.utime;
  station.name = s.station;
  station.uid = station_uid(site.site, station.name);
  station.place = place_of(s.latitude_deg, s.longitude_deg, s.height_m, site);
  std::ranges::copy(s.position_sd_m, station.position_sd_m.begin());
  station.azimuth_deg = degrees(s.azimuth_rad);
  station.elevation_deg = degrees(s.elevation_rad);
  for (std::size_t i = 0; i < 2; ++i) {
    const double field_deg = degrees(s.field_of_view_rad[i]);
    station.field_of_view_deg[i] = field_deg > 0.0 && field_deg < 360.0 ? field_deg : 0.0;
  }
  station.state = wire::state_name(s.state);
  station.alarms = s.alarm.size();
  station.is_well = s.alarm.empty();
  station.clock_is_good = s.clock_state == Bearing::CLOCK_SYNCHRONISED;
  return station;
}

std::optional<Line> line_from(const BusMessage& message, const SiteContext& site) {
  const auto content = wire::read<Bearing>(kBearingChannel, message);
  if (!content || content->detected) return std::nullopt;  // nobody has designated it
  const Bearing& b = *content;
  const Eigen::Vector3d camera(b.camera_ecef_m[0], b.camera_ecef_m[1], b.camera_ecef_m[2]);
  if (!(camera.cwiseAbs().maxCoeff() < kMostEarth_m) || !std::isfinite(b.azimuth_rad) ||
      !(std::abs(b.elevation_rad) <= kPi / 2.0)) {
    return std::nullopt;
  }
  const Geodetic at = geodetic_from_ecef(camera);
  Line line;
  line.utime_us = b.utime;
  line.station = plain_text(b.station);
  line.uid = line_uid(site.site, line.station);
  line.camera = place_of(degrees(at.latitude_rad), degrees(at.longitude_rad), at.height_m, site);
  line.azimuth_deg = degrees(wrap_two_pi(b.azimuth_rad));
  line.elevation_deg = degrees(b.elevation_rad);
  const auto sd_deg = [&b](int i) {
    return degrees(std::sqrt(b.covariance_white_rad2[i] + b.covariance_systematic_rad2[i]));
  };
  line.cross_sd_deg = sd_deg(0);
  line.elevation_sd_deg = sd_deg(2);
  line.belief = b.belief;
  line.track_id = b.track_id;
  return line;
}

std::optional<Incident> incident_from(const BusMessage& message, const SiteContext& site) {
  const auto content = wire::read<IncidentMessage>(kIncidentChannel, message);
  if (!content ||
      !wire::is_place(content->latitude_deg, content->longitude_deg, content->height_m)) {
    return std::nullopt;
  }
  const IncidentMessage& m = *content;
  Incident incident;
  incident.utime_us = m.utime;
  incident.uid = incident_uid(site.site, m.number, m.begun_utime);
  incident.number = m.number;
  incident.area = plain_text(m.area);
  incident.target_id = m.target_id;
  incident.target_uid = target_uid(site.site, m.target_boot_id, m.target_id);
  incident.object_class = plain_text(m.object_class);
  if (m.class_probability > 0.0) incident.class_probability = std::min(m.class_probability, 1.0);
  incident.begun_us = m.begun_utime;
  incident.ended_us = m.ended_utime;
  incident.place = place_of(m.latitude_deg, m.longitude_deg, m.height_m, site);
  incident.verdict = word_of_code(m.verdict, std::array{"open", "confirmed", "dismissed"}, "open");
  incident.judged_by = plain_text(m.judged_by);
  for (std::size_t i = 0; i < std::min(m.station.size(), kMostStations); ++i) {
    incident.stations.push_back(plain_text(m.station[i]));
  }
  return incident;
}

bool is_understood(const BusMessage& message) {
  return wire::decode_target(message) || wire::decode_status(message) ||
         wire::read<Bearing>(kBearingChannel, message) ||
         wire::read<IncidentMessage>(kIncidentChannel, message);
}

bool is_read(const std::string& channel) {
  return channel == kTargetChannel || channel == kIncidentChannel ||
         channel.starts_with(kStatusChannel) || channel.starts_with(kBearingChannel);
}

}  // namespace ols::exports
