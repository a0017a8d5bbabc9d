#include "console/messages.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/bus/channel_names.h"
#include "base/bus/message_code.h"
#include "base/text/plain_text.h"
#include "conditions/alarm_json.h"
#include "console/map_geometry.h"
#include "console/messages_calibration.h"
#include "console/messages_cues.h"
#include "console/rounded.h"
#include "geometry/angles.h"
#include "geometry/mgrs.h"
#include "geometry/wgs84.h"
#include "ols_msg/bearing_t.hpp"
#include "ols_msg/fusion_status_t.hpp"
#include "ols_msg/occlusion_t.hpp"
#include "ols_msg/skyline_t.hpp"
#include "ols_msg/target_t.hpp"
#include "wire/fusion_status.h"
#include "wire/read.h"
#include "wire/skyline.h"
#include "wire/station_status.h"
#include "wire/target.h"

namespace ols::console {
namespace {

using Status = ols_msg::station_status_t;
using Target = ols_msg::target_t;

constexpr std::size_t kMostBorders = 16;  // of a station, and points of each
constexpr int kMgrsDigits = 5;            // to the metre
constexpr std::size_t kMostListed = 300;  // of counters and the like; a forged message has more

Json named(const std::vector<std::string>& names, const std::vector<double>& values) {
  Json result = Json::object();
  for (std::size_t i = 0; i < std::min(names.size(), kMostListed); ++i) {
    result[names[i]] = rounded(values[i], 6);
  }
  return result;
}

Json devices_of(const Status& s) {
  Json devices = Json::array();
  for (std::size_t i = 0; i < std::min(s.device_name.size(), kMostListed); ++i) {
    devices.push_back({{"name", s.device_name[i]},
                       {"state", wire::device_name(s.device_state[i])},
                       {"text", s.device_text[i]},
                       {"age_s", rounded(s.device_age_s[i], 1)}});
  }
  return devices;
}

// Null where there is none.
Json lens_of(const Status& s) {
  if (s.kind != Status::KIND_OVERVIEW) return nullptr;
  return {{"zoom", rounded(s.lens_position[0], 4)},
          {"focus", rounded(s.lens_position[1], 4)},
          {"iris", rounded(s.lens_position[2], 4)},
          {"focal_length_px", rounded(s.focal_length_px, 1)},
          {"focal_length_sd_px", rounded(s.focal_length_sd_px, 2)}};
}

// Each with the key by which the page finds its event.
void add_alarms(const std::vector<Alarm>& alarms, Json& fields) {
  Json& all = fields["alarms"] = alarms;
  for (std::size_t i = 0; i < alarms.size(); ++i) all[i]["key"] = alarms[i].key();
}

// Null for what is no place: a station's, while it does not know its own.
Json mgrs_of(double latitude_deg, double longitude_deg, double height_m) {
  try {
    return mgrs(Geodetic{radians(latitude_deg), radians(longitude_deg), height_m}, kMgrsDigits);
  } catch (const std::invalid_argument&) {
    return nullptr;
  }
}

void add_pose(const Status& s, Json& fields) {
  fields["latitude_deg"] = rounded(s.latitude_deg, 8);
  fields["longitude_deg"] = rounded(s.longitude_deg, 8);
  fields["height_m"] = rounded(s.height_m, 2);
  fields["mgrs"] = mgrs_of(s.latitude_deg, s.longitude_deg, s.height_m);
  fields["camera_ecef_m"] = {rounded(s.camera_ecef_m[0], 3), rounded(s.camera_ecef_m[1], 3),
                             rounded(s.camera_ecef_m[2], 3)};
  fields["position_sd_m"] = {rounded(s.position_sd_m[0], 3), rounded(s.position_sd_m[1], 3),
                             rounded(s.position_sd_m[2], 3)};
  fields["position_source"] = wire::source_name(s.position_source);
  fields["heading_deg"] = angle_deg(s.heading_rad);
  fields["heading_sd_deg"] = angle_deg(s.heading_sd_rad);
  fields["tilt_x_deg"] = angle_deg(s.tilt_x_rad);
  fields["tilt_y_deg"] = angle_deg(s.tilt_y_rad);
  fields["tilt_sd_deg"] = angle_deg(s.tilt_sd_rad);
  fields["tilt_source"] = wire::source_name(s.tilt_source);
}

// [{keep_out, outline: [[azimuth_deg, elevation_deg], ...]}]
Json borders_of(const Status& s) {
  Json borders = Json::array();
  const std::size_t points =
      s.border_kind.empty() ? 0 : s.border_azimuth_rad.size() / s.border_kind.size();
  for (std::size_t i = 0; points > 2 && i < std::min(s.border_kind.size(), kMostBorders); ++i) {
    Json outline = Json::array();
    for (std::size_t k = i * points; k < i * points + std::min(points, kMostBorders); ++k) {
      outline.push_back({rounded(degrees(s.border_azimuth_rad[k]), 3),
                         rounded(degrees(s.border_elevation_rad[k]), 3)});
    }
    borders.push_back({{"keep_out", s.border_kind[i] == Status::BORDER_KEEP_OUT},
                       {"outline", std::move(outline)}});
  }
  return borders;
}

void add_pointing(const Status& s, Json& fields) {
  fields["pan_deg"] = angle_deg(s.pan_rad);
  fields["tilt_deg"] = angle_deg(s.tilt_rad);
  fields["pan_limits_deg"] = {angle_deg(s.pan_limits_rad[0]), angle_deg(s.pan_limits_rad[1])};
  fields["tilt_limits_deg"] = {angle_deg(s.tilt_limits_rad[0]), angle_deg(s.tilt_limits_rad[1])};
  fields["borders"] = borders_of(s);
  fields["azimuth_deg"] = angle_deg(s.azimuth_rad);
  fields["elevation_deg"] = angle_deg(s.elevation_rad);
  fields["target_offset_px"] = {rounded(s.target_offset_px[0], 1),
                                rounded(s.target_offset_px[1], 1)};
  fields["image_px"] = {s.image_width_px, s.image_height_px};
  fields["pan_sign"] = s.pan_sign;
  fields["tilt_sign"] = s.tilt_sign;
  fields["kind"] = word_of_code(s.kind, std::array{"tracking", "overview", "fixed"}, "tracking");
  fields["lens"] = lens_of(s);
  fields["field_of_view_deg"] = {angle_deg(s.field_of_view_rad[0]),
                                 angle_deg(s.field_of_view_rad[1])};
}

// Null for what is not known.
void add_appearance(const Target& t, Json& fields) {
  const auto known = [](double value, int digits) {
    return value > 0.0 ? Json(rounded(value, digits)) : Json(nullptr);
  };
  fields["class"] = to_string(wire::object_class_of(t.object_class));
  fields["class_probability"] = known(t.class_probability, 2);
  fields["size_m"] = known(t.size_m, 2);
  fields["size_sd_m"] = known(t.size_sd_m, 2);
  fields["signal"] = known(t.signal, 1);
  const bool has_ground = t.has_height_above_ground != 0;
  const auto above = [&](double value_m) {
    return has_ground ? Json(rounded(value_m, 1)) : Json(nullptr);
  };
  fields["height_above_ground_m"] = above(t.height_above_ground_m);
  fields["height_above_ground_sd_m"] = above(t.height_above_ground_sd_m);
}

Json stations_of(const Target& t) {
  Json stations = Json::array();
  for (std::size_t i = 0; i < std::min(t.station.size(), kMostListed); ++i) {
    stations.push_back({{"id", t.station[i]},
                        {"used", t.used[i] != 0},
                        {"weight", rounded(t.weight[i], 2)},
                        {"age_s", rounded(t.age_s[i], 2)}});
  }
  return stations;
}

void add_motion(const Target& t, Json& fields) {
  const Eigen::Vector3d velocity = wire::velocity_enu(t);
  fields["velocity_enu_m_s"] = {rounded(velocity.x(), 2), rounded(velocity.y(), 2),
                                rounded(velocity.z(), 2)};
  fields["speed_m_s"] = rounded(velocity.norm(), 2);
  fields["course_deg"] = rounded(degrees(wrap_two_pi(std::atan2(velocity.x(), velocity.y()))), 1);
}

void add_position(const Target& t, Json& fields) {
  const auto* covariance = t.position_covariance_enu_m2;
  fields["latitude_deg"] = rounded(t.latitude_deg, 8);
  fields["longitude_deg"] = rounded(t.longitude_deg, 8);
  fields["height_m"] = rounded(t.height_m, 2);
  fields["mgrs"] = mgrs_of(t.latitude_deg, t.longitude_deg, t.height_m);
  fields["sd_enu_m"] = {rounded(std::sqrt(covariance[0]), 3), rounded(std::sqrt(covariance[3]), 3),
                        rounded(std::sqrt(covariance[5]), 3)};
  fields["covariance_enu_m2"] = rounded_all(t.position_covariance_enu_m2, 4);
  fields["ellipse95"] = ellipse95(covariance[0], covariance[1], covariance[3]);
  fields["crossing_angle_deg"] = rounded(degrees(t.crossing_angle_rad), 1);
  fields["residual"] = rounded(t.residual, 2);
  fields["stations"] = stations_of(t);
  add_appearance(t, fields);
  add_motion(t, fields);
}

Json fusion_stations(const ols_msg::fusion_status_t& f) {
  Json stations = Json::array();
  for (std::size_t i = 0; i < std::min(f.station.size(), kMostListed); ++i) {
    stations.push_back({{"id", f.station[i]},
                        {"bearings", f.bearings[i]},
                        {"rate_hz", rounded(f.rate_hz[i], 1)},
                        {"age_s", rounded(f.age_s[i], 2)},
                        {"residual", rounded(f.residual[i], 2)},
                        {"clock_offset_s", rounded(f.clock_offset_s[i], 4)},
                        {"quarantine", f.quarantine[i]},
                        {"calibration", calibration_of(f, i)}});
  }
  return stations;
}

// The address of a station's video socket; empty without one that works.
std::string video_address_of(const Status& s) {
  for (std::size_t i = 0; i < s.device_name.size(); ++i) {
    if (s.device_name[i] == "video" && s.device_state[i] == Status::DEVICE_OK) {
      return s.device_text[i];
    }
  }
  return {};
}

}  // namespace

std::optional<ReceivedStation> station_from(const BusMessage& message) {
  const auto status = wire::decode_status(message);
  if (!status) return std::nullopt;
  const Status& s = *status;
  Json fields{
      {"boot", number_text(s.boot_id)},
      {"utime_us", s.utime},
      {"state", wire::state_name(s.state)},
      {"track_id", number_text(s.track_id)},
      {"belief", rounded(s.belief, 3)},
      {"hidden_since_utime_us", s.hidden_since_utime},
      {"hidden_until_utime_us", s.hidden_until_utime},
      {"devices", devices_of(s)},
      {"clock",
       {{"state", wire::clock_name(s.clock_state)}, {"error_s", rounded(s.clock_error_s, 6)}}},
      {"calibration", calibration_of(s)},
      {"frame_latency_s", rounded(s.frame_latency_s, 3)},
      {"readings", named(s.reading_name, s.reading_value)},
      {"counters", named(s.counter_name, s.counter_value)},
      {"last_error", s.last_error},
      {"last_error_utime_us", s.last_error_utime}};
  std::vector<Alarm> alarms = alarms_of(s, kMostListed);
  add_alarms(alarms, fields);
  add_pose(s, fields);
  add_pointing(s, fields);
  return ReceivedStation{s.station,           std::move(fields), wire::is_stopped(s.state),
                         video_address_of(s), std::move(alarms), s.last_error,
                         s.last_error_utime};
}

std::optional<std::pair<std::string, Json>> bearing_from(const BusMessage& message) {
  const auto heard = wire::read<ols_msg::bearing_t>(kBearingChannel, message);
  if (!heard) return std::nullopt;
  const ols_msg::bearing_t& b = *heard;
  if (b.detected) return std::nullopt;  // a station's line is that of its followed target
  const double variance = (b.covariance_white_rad2[0] + b.covariance_systematic_rad2[0] +
                           b.covariance_white_rad2[2] + b.covariance_systematic_rad2[2]) /
                          2;
  return std::pair{b.station, Json{{"utime_us", b.utime},
                                   {"azimuth_deg", angle_deg(b.azimuth_rad)},
                                   {"elevation_deg", angle_deg(b.elevation_rad)},
                                   {"sd_deg", angle_deg(std::sqrt(variance))},
                                   {"belief", rounded(b.belief, 2)}}};
}

std::optional<ReceivedTarget> target_from(const BusMessage& message) {
  using What = ReceivedTarget::What;
  const auto content = wire::decode_target(message);
  if (!content) return std::nullopt;
  const Target& t = *content;
  ReceivedTarget heard{.what = What::kNothing,
                       .boot_id = t.boot_id,
                       .id = number_text(t.target_id),
                       .fields = Json::object()};
  heard.fields["utime_us"] = t.utime;
  heard.fields["solution"] = wire::solution_name(t.solution);
  if (t.solution == Target::SOLUTION_BEARING_ONLY) {
    if (t.station.empty()) return std::nullopt;
    heard.what = What::kLine;
    heard.id = plain_text(t.station.front());
    heard.fields["target"] = number_text(t.target_id);
    heard.fields["azimuth_deg"] = angle_deg(t.azimuth_rad);
    heard.fields["elevation_deg"] = angle_deg(t.elevation_rad);
    heard.fields["sd_deg"] = angle_deg(t.direction_sd_rad);
    return heard;
  }
  if (t.target_id == 0) return heard;
  heard.fields["state"] = wire::track_name(t.track_state);
  if (t.track_state == Target::TRACK_DROPPED) {
    heard.what = What::kDropped;
  } else if (wire::has_position(t)) {
    heard.what = What::kPosition;
    heard.fields["estimator"] = t.estimator;
    heard.latitude_deg = t.latitude_deg;
    heard.longitude_deg = t.longitude_deg;
    heard.height_m = t.height_m;
    add_position(t, heard.fields);
  } else {
    heard.what = What::kNoPosition;
  }
  return heard;
}

std::optional<ReceivedSkyline> skyline_from(const BusMessage& message) {
  const auto heard = wire::read<ols_msg::skyline_t>(kSkylineChannel, message);
  if (!heard || !wire::is_skyline(*heard)) return std::nullopt;
  ReceivedSkyline skyline{heard->station, heard->begun_utime, heard->sector};
  for (std::size_t i = 0; i < heard->column.size(); ++i) {
    if (heard->disagrees[i])
      skyline.differing.emplace_back(heard->column[i], heard->elevation_rad[i]);
  }
  return skyline;
}

std::optional<ReceivedOcclusion> occlusion_from(const BusMessage& message) {
  const auto heard = wire::read<ols_msg::occlusion_t>(kOcclusionChannel, message);
  if (!heard) return std::nullopt;
  return ReceivedOcclusion{.station = heard->station,
                           .target = number_text(heard->target_id),
                           .is_hidden = heard->hidden > 0.5,
                           .utime_us = heard->utime,
                           .back_us = heard->exit_utime,
                           .holds_s = heard->holds_s};
}

std::optional<ReceivedFusion> fusion_from(const BusMessage& message) {
  const auto heard = wire::decode_fusion_status(message);
  if (!heard) return std::nullopt;
  const ols_msg::fusion_status_t& f = *heard;
  Json fields{{"boot", number_text(f.boot_id)},
              {"utime_us", f.utime},
              {"stations", fusion_stations(f)},
              {"cues", cues_of(f)},
              {"handover", f.handover},
              {"latency_s", rounded(f.latency_s, 4)},
              {"counters", named(f.counter_name, f.counter_value)},
              {"last_error", f.last_error}};
  std::vector<Alarm> alarms = alarms_of(f, kMostListed);
  add_alarms(alarms, fields);
  return ReceivedFusion{f.boot_id, std::move(fields), std::move(alarms), f.last_error};
}

}  // namespace ols::console
