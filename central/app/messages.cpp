#include "central/app/messages.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string_view>
#include <utility>

#include "base/bus/message_code.h"
#include "base/bus/message_stamp.h"
#include "base/text/plain_text.h"
#include "central/admission/bearing_check.h"
#include "conditions/alarms.h"
#include "geometry/angles.h"
#include "geometry/wgs84.h"
#include "ols_msg/bearing_t.hpp"
#include "ols_msg/cue_order_t.hpp"
#include "ols_msg/cue_t.hpp"
#include "ols_msg/skyline_t.hpp"
#include "ols_msg/station_status_t.hpp"
#include "wire/read.h"
#include "wire/skyline.h"

namespace ols::fusion {
namespace {

constexpr std::size_t kAlarms = 16;         // max number in a status
constexpr std::size_t kLongestError = 500;  // in a status
constexpr std::size_t kLongestId = 100;     // of a cue

template <class Message>
std::optional<MessageRefusal> decode(std::string_view channel, std::string_view on,
                                     const void* data, int bytes, Message& message) {
  auto found = wire::read<Message>(channel, on, data, bytes);
  if (const auto* why = std::get_if<wire::Unread>(&found)) {
    return *why == wire::Unread::kMalformed ? MessageRefusal::kMalformed
           : *why == wire::Unread::kSchema  ? MessageRefusal::kSchema
                                            : MessageRefusal::kOtherStation;
  }
  message = std::move(std::get<Message>(found));
  return std::nullopt;
}

Eigen::Matrix2d symmetric(const double (&xx_xy_yy)[3]) {
  Eigen::Matrix2d matrix;
  matrix << xx_xy_yy[0], xx_xy_yy[1], xx_xy_yy[1], xx_xy_yy[2];
  return matrix;
}

// The operator has precedence over the fusion.
bool commandable(std::int8_t state) {
  using ols_msg::station_status_t;
  return state != station_status_t::STATE_MANUAL && state != station_status_t::STATE_STOPPED &&
         state != station_status_t::STATE_EMERGENCY;
}

// ee, en, eu, nn, nu, uu at the target's own horizon.
void enu_triangle(const Eigen::Matrix3d& covariance_ecef, const Eigen::Matrix3d& R_ecef_enu,
                  double (&out)[6]) {
  const Eigen::Matrix3d enu = R_ecef_enu.transpose() * covariance_ecef * R_ecef_enu;
  int next = 0;
  for (int row = 0; row < 3; ++row) {
    for (int column = row; column < 3; ++column) out[next++] = enu(row, column);
  }
}

void fill_position(const Estimate& estimate, ols_msg::target_t& message) {
  const bool located = estimate.solution == Solution::kOk;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Geodetic place{nan, nan, nan};
  Eigen::Matrix3d R = nan_matrix();
  if (located) {
    place = geodetic_from_ecef(estimate.position_ecef);
    R = R_ecef_enu(place);
  }
  message.latitude_deg = degrees(place.latitude_rad);
  message.longitude_deg = degrees(place.longitude_rad);
  message.height_m = place.height_m;
  for (int i = 0; i < 3; ++i) {
    message.position_ecef_m[i] = estimate.position_ecef(i);
    message.velocity_ecef_m_s[i] = estimate.velocity_ecef(i);
  }
  enu_triangle(estimate.covariance_ecef, R, message.position_covariance_enu_m2);
  enu_triangle(estimate.covariance_white_ecef, R, message.position_covariance_white_enu_m2);
  enu_triangle(estimate.velocity_covariance_ecef, R, message.velocity_covariance_enu_m2_s2);
}

void fill_bearing(const std::optional<BearingOnly>& only, ols_msg::target_t& message) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  message.azimuth_rad = message.elevation_rad = message.direction_sd_rad = nan;
  message.direction_rate_rad_s[0] = message.direction_rate_rad_s[1] = nan;
  if (!only) return;
  const LineOfSight& sight = only->sight;
  message.azimuth_rad = sight.direction.azimuth_rad;
  message.elevation_rad = sight.direction.elevation_rad;
  message.direction_sd_rad =
      std::sqrt((sight.covariance_white + sight.covariance_systematic).trace() / 2.0);
  for (int axis = 0; axis < 2; ++axis) message.direction_rate_rad_s[axis] = only->rate_rad_s(axis);
}

void fill_appearance(const Appearance& appearance, ols_msg::target_t& message) {
  message.object_class = code(appearance.object_class);
  message.class_probability = appearance.class_probability;
  message.size_m = appearance.size_m;
  message.size_sd_m = appearance.size_sd_m;
  message.signal = appearance.signal;
}

void fill_above_ground(const std::optional<HeightAboveGround>& above, ols_msg::target_t& message) {
  message.has_height_above_ground = above ? 1 : 0;
  message.height_above_ground_m = above ? above->height_m : 0.0;
  message.height_above_ground_sd_m = above ? above->sd_m : 0.0;
}

static_assert(code(Solution::kRaysMiss) == ols_msg::target_t::SOLUTION_RAYS_MISS);
static_assert(code(TrackState::kDeleted) == ols_msg::target_t::TRACK_DROPPED);
static_assert(code(CalibrationState::kDoubted) == ols_msg::station_status_t::CALIBRATION_DOUBTED);
static_assert(code(StationClock::kUnsynchronised) == ols_msg::bearing_t::CLOCK_UNSYNCHRONISED);
static_assert(code(CueState::kForbidden) == ols_msg::fusion_status_t::CUE_FORBIDDEN);

// The stations that this status reports. With texts of maximum length, no more fit into a datagram;
// the next status reports the next ones.
std::span<const StationHealth> in_turn(const std::vector<StationHealth>& all,
                                       std::int64_t sequence) {
  constexpr std::size_t kMost = 250;
  const std::size_t turns = std::max<std::size_t>(1, (all.size() + kMost - 1) / kMost);
  const std::size_t first = kMost * (static_cast<std::size_t>(sequence) % turns);
  return std::span(all).subspan(first, std::min(kMost, all.size() - first));
}

}  // namespace

const char* to_string(MessageRefusal refusal) {
  switch (refusal) {
    case MessageRefusal::kMalformed:
      return "messages_malformed";
    case MessageRefusal::kSchema:
      return "messages_schema";
    case MessageRefusal::kOtherStation:
      return "messages_other_station";
    case MessageRefusal::kOutOfRange:
      return "messages_out_of_range";
    case MessageRefusal::kNoPosition:
      return "messages_without_position";
  }
  return "unknown";
}

namespace {

Sighted sighted_in(const ols_msg::bearing_t& message) {
  return {.rate_rad_s = Eigen::Vector2d(message.rate_rad_s),
          .rate_covariance = symmetric(message.rate_covariance_rad2_s2),
          .size_rad = message.size_rad,
          .size_sd_rad = message.size_sd_rad,
          .across_rad = message.across_rad,
          .size_noise_rad = message.size_noise_rad,
          .signal = message.signal,
          .class_probability = message.class_probability};
}

}  // namespace

std::variant<BearingMeasurement, MessageRefusal> measurement_from(const std::string& channel,
                                                                  const void* data, int bytes) {
  ols_msg::bearing_t message;
  const auto refusal = decode(kBearingChannel, channel, data, bytes, message);
  if (refusal) return *refusal;
  BearingMeasurement measurement;
  measurement.station = message.station;
  measurement.utime_us = message.utime;
  measurement.boot_id = message.boot_id;
  measurement.track_id = message.track_id;
  measurement.belief = message.belief;
  measurement.clock_sd_s = message.clock_error_s;
  measurement.clock =
      from_code(message.clock_state, StationClock::kUnsynchronised, StationClock::kUnknown);
  measurement.calibration_id = message.calibration_id;
  measurement.sight.origin_ecef = Eigen::Vector3d(message.camera_ecef_m);
  measurement.sight.direction = {message.azimuth_rad, message.elevation_rad};
  measurement.sight.covariance_white = symmetric(message.covariance_white_rad2);
  measurement.sight.covariance_systematic = symmetric(message.covariance_systematic_rad2);
  measurement.sight.aim_sd_rad = message.aim_sd_rad;
  measurement.sight.origin_sd_enu_m = Eigen::Vector3d(message.camera_position_sd_m);
  measurement.is_tracklet = message.detected != 0;
  measurement.is_acquired = message.acquired != 0;
  measurement.image_bearings = message.image_bearings;
  measurement.sighted = sighted_in(message);
  return measurement;
}

namespace {

// "ONVIF Maker Model, serial 1234: moves absolute ..." without the end; empty without a serial
// number that distinguishes one device from another.
std::string stated_mount(const ols_msg::station_status_t& message) {
  const auto named = std::ranges::find(message.device_name, "ptu");
  if (named == message.device_name.end()) return {};
  constexpr std::string_view kSerial = ", serial ";
  constexpr std::size_t kLongest = 200;
  const std::string& text =
      message.device_text[static_cast<std::size_t>(named - message.device_name.begin())];
  const std::size_t at = text.find(kSerial);
  const std::size_t end = at == std::string::npos ? at : text.find(": ", at);
  if (end == std::string::npos || end > kLongest) return {};
  const std::size_t first = text.find_first_not_of("0 ", at + kSerial.size());
  return first < end ? plain_text(text.substr(0, end)) : std::string();
}

}  // namespace

std::variant<StationPlace, MessageRefusal> station_place_from(const std::string& channel,
                                                              const void* data, int bytes) {
  ols_msg::station_status_t message;
  const auto refusal = decode(kStatusChannel, channel, data, bytes, message);
  if (refusal) return *refusal;
  StationPlace place{message.station, {}};
  place.traits.mount = stated_mount(message);
  place.traits.stated_us = message.utime;
  place.traits.calibration = {
      from_code(message.calibration_state, CalibrationState::kDoubted, CalibrationState::kNone),
      message.calibration_utime, message.calibration_sd_rad};
  // An overview station is steered by a person, and a fixed one does not move.
  place.traits.commandable =
      commandable(message.state) && message.kind == ols_msg::station_status_t::KIND_TRACKING;
  if (message.position_source == ols_msg::station_status_t::POSE_NONE) {
    place.no_place = MessageRefusal::kNoPosition;
    return place;
  }
  place.traits.camera_ecef = Eigen::Vector3d(message.camera_ecef_m);
  place.traits.camera_sd_enu_m = Eigen::Vector3d(message.position_sd_m);
  const StationTraits& traits = place.traits;
  if (!traits.camera_sd_enu_m.allFinite() ||
      !is_a_stations_place(traits.camera_ecef, traits.camera_sd_enu_m)) {
    place.no_place = MessageRefusal::kOutOfRange;
  }
  const double view_rad = std::min(message.field_of_view_rad[0], message.field_of_view_rad[1]);
  if (view_rad > 1e-4 && view_rad <= 2.0 * kPi) {
    place.traits.field_of_view_rad = std::min(view_rad, kPi);
  }
  if (std::isfinite(message.azimuth_rad) && std::abs(message.elevation_rad) <= kPi / 2.0) {
    place.traits.axis = AzimuthElevation{message.azimuth_rad, message.elevation_rad};
  }
  constexpr double kLatestS = 2.0;
  if (message.frame_latency_s > 0.0 && message.frame_latency_s < kLatestS) {
    place.traits.latency_s = message.frame_latency_s;
  }
  return place;
}

std::variant<SkylineSector, MessageRefusal> skyline_sector_from(const std::string& channel,
                                                                const void* data, int bytes) {
  ols_msg::skyline_t message;
  const auto refusal = decode(kSkylineChannel, channel, data, bytes, message);
  if (refusal) return *refusal;
  if (!wire::is_skyline(message)) return MessageRefusal::kOutOfRange;
  static_assert(wire::kSkylineSectors == land::SeenSkyline::kSectors &&
                wire::kSkylineSectorColumns == land::SeenSkyline::kSectorColumns);
  SkylineSector sector{.station = message.station,
                       .begun_us = message.begun_utime,
                       .camera_ecef = Eigen::Vector3d(message.camera_ecef_m),
                       .heading_disagrees = message.heading_disagrees != 0,
                       .sector = message.sector,
                       .columns = {}};
  for (std::size_t i = 0; i < message.column.size(); ++i) {
    sector.columns.push_back({message.column[i],
                              {message.elevation_rad[i], message.sd_rad[i], message.hides_from_m[i],
                               message.disagrees[i] != 0}});
  }
  return sector;
}

std::variant<std::int64_t, MessageRefusal> fusion_boot_from(const void* data, int bytes) {
  ols_msg::fusion_status_t message;
  constexpr auto kChannel = kFusionStatusChannel;
  if (const auto refusal = decode(kChannel, kChannel, data, bytes, message)) return *refusal;
  return message.boot_id;
}

std::variant<Cue, MessageRefusal> cue_from(const void* data, int bytes) {
  ols_msg::cue_t message;
  if (const auto refusal = decode(kCueChannel, kCueChannel, data, bytes, message)) return *refusal;
  // A number is the name of a target: an operator's order for such a cue would go to the target.
  if (message.id.size() > kLongestId || target_named(message.id)) return MessageRefusal::kMalformed;
  Cue cue;
  cue.id = plain_text(message.id);
  cue.label = plain_text(message.label.substr(0, kLongestId));
  cue.utime_us = message.utime;
  cue.state_us = message.state_utime;
  cue.place = {radians(message.latitude_deg), radians(message.longitude_deg), message.height_m};
  cue.horizontal_sd_m = message.horizontal_sd_m;
  cue.vertical_sd_m = message.vertical_sd_m;
  cue.velocity_enu_m_s = Eigen::Vector3d(message.velocity_enu_m_s);
  cue.velocity_sd_m_s = message.velocity_sd_m_s;
  return cue;
}

std::variant<CueOrder, MessageRefusal> cue_order_from(const void* data, int bytes) {
  ols_msg::cue_order_t message;
  constexpr auto kChannel = kCueOrderChannel;
  if (const auto refusal = decode(kChannel, kChannel, data, bytes, message)) return *refusal;
  if (!(message.lease_s > 0.0) || message.cue.size() > kLongestId) {
    return MessageRefusal::kOutOfRange;
  }
  const auto handover = handover_mode_named(message.handover);
  if (!message.handover.empty() && !handover) return MessageRefusal::kOutOfRange;
  return CueOrder{.cue = plain_text(message.cue),
                  .allow = message.allow != 0,
                  .handover = handover,
                  .utime_us = message.utime,
                  .lease_s = message.lease_s,
                  .boot_id = message.boot_id,
                  .sequence = message.sequence};
}

ols_msg::target_t to_message(const FusedTarget& target, const MessageStamp& stamp) {
  ols_msg::target_t message;
  stamp_message(message, target.utime_us, stamp.boot_id, stamp.sequence);
  message.target_id = target.target_id;
  message.estimator = target.estimator;
  message.solution = code(target.estimate.solution);
  message.track_state = code(target.state);
  fill_position(target.estimate, message);
  fill_bearing(target.bearing_only, message);
  fill_appearance(target.appearance, message);
  fill_above_ground(target.above_ground, message);
  message.crossing_angle_rad = target.estimate.crossing_angle_rad;
  message.residual = target.estimate.residual;
  message.stations = static_cast<std::int16_t>(target.stations.size());
  for (const ContributingStation& station : target.stations) {
    message.station.push_back(station.station);
    message.used.push_back(static_cast<std::int8_t>(station.used));
    message.weight.push_back(station.weight);
    message.age_s.push_back(station.age_s);
  }
  return message;
}

ols_msg::command_reply_t to_message(const CueReply& reply, const MessageStamp& stamp,
                                    std::int64_t utime_us) {
  ols_msg::command_reply_t message{};
  stamp_message(message, utime_us, stamp.boot_id, stamp.sequence);
  message.order_boot_id = reply.boot_id;
  message.order_sequence = reply.sequence;
  message.accepted = reply.reason.empty() ? 1 : 0;
  message.reason = reply.reason;
  return message;
}

ols_msg::occlusion_t to_message(const OcclusionNotice& notice, const MessageStamp& stamp) {
  constexpr double kLease_s = 0.5;
  ols_msg::occlusion_t message{};
  stamp_message(message, notice.utime_us, stamp.boot_id, stamp.sequence);
  message.station = notice.station;
  message.lease_s = kLease_s;
  message.holds_s = notice.holds_s;
  message.target_id = notice.target_id;
  message.hidden = notice.hidden;
  if (!notice.exit) return message;
  const Emergence& exit = *notice.exit;
  message.exit_utime = notice.utime_us + std::llround(1e6 * exit.in_s);
  message.exit_sd_s = exit.sd_s;
  message.azimuth_rad = exit.direction.azimuth_rad;
  message.elevation_rad = exit.direction.elevation_rad;
  message.exit_covariance_rad2[0] = exit.covariance(0, 0);
  message.exit_covariance_rad2[1] = exit.covariance(0, 1);
  message.exit_covariance_rad2[2] = exit.covariance(1, 1);
  return message;
}

ols_msg::slew_t to_message(const Slew& slew, const MessageStamp& stamp) {
  ols_msg::slew_t message;
  stamp_message(message, slew.utime_us, stamp.boot_id, stamp.sequence);
  message.station = slew.station;
  message.lease_s = slew.lease_s;
  message.target_id = slew.target_id;
  message.effect_utime = slew.effect_utime_us;
  message.azimuth_rad = slew.direction.azimuth_rad;
  message.elevation_rad = slew.direction.elevation_rad;
  message.azimuth_rate_rad_s = slew.azimuth_rate_rad_s;
  message.elevation_rate_rad_s = slew.elevation_rate_rad_s;
  message.direction_sd_rad = slew.direction_sd_rad;
  std::ranges::copy(slew.line, message.line);
  message.let_go_track_id = slew.let_go_track_id;
  return message;
}

namespace {

void fill_cues(const std::vector<CueHealth>& cues, ols_msg::fusion_status_t& message) {
  message.cues = static_cast<std::int16_t>(cues.size());
  for (const CueHealth& cue : cues) {
    message.cue_id.push_back(cue.id);
    message.cue_label.push_back(cue.label);
    message.cue_state.push_back(code(cue.state));
    message.cue_target_id.push_back(cue.target_id);
    message.cue_age_s.push_back(cue.age_s);
    message.cue_latitude_deg.push_back(degrees(cue.place.latitude_rad));
    message.cue_longitude_deg.push_back(degrees(cue.place.longitude_rad));
    message.cue_height_m.push_back(cue.place.height_m);
    message.cue_horizontal_sd_m.push_back(cue.horizontal_sd_m);
    message.cue_vertical_sd_m.push_back(cue.vertical_sd_m);
  }
}

}  // namespace

ols_msg::fusion_status_t to_message(const FusionHealth& health, double latency_s,
                                    const MessageStamp& stamp) {
  ols_msg::fusion_status_t message;
  fill_cues(health.cues, message);
  message.handover = to_string(health.handover);
  stamp_message(message, health.now_us, stamp.boot_id, stamp.sequence);
  message.stations_known = static_cast<std::int32_t>(health.stations.size());
  const auto told = in_turn(health.stations, stamp.sequence);
  message.stations = static_cast<std::int16_t>(told.size());
  for (const StationHealth& station : told) {
    message.station.push_back(station.station);
    message.bearings.push_back(station.bearings);
    message.rate_hz.push_back(station.rate_hz);
    message.age_s.push_back(station.age_s);
    message.residual.push_back(station.residual);
    message.clock_offset_s.push_back(station.clock_offset_s);
    message.quarantine.push_back(station.quarantine.reason());
    const StationBiasReport& found = station.finding;
    message.bias_rad.push_back({found.bias_rad.x(), found.bias_rad.y()});
    message.bias_sd_rad.push_back({found.bias_sd_rad.x(), found.bias_sd_rad.y()});
    message.clock_found_s.push_back(found.clock_s);
    message.clock_found_sd_s.push_back(found.clock_sd_s);
    message.calibration_state.push_back(code(station.calibration.state));
    message.calibration_utime.push_back(station.calibration.observed_utime_us);
    message.calibration_sd_rad.push_back(station.calibration.sd_rad);
  }
  message.latency_s = latency_s;
  message.counters = static_cast<std::int16_t>(health.counters.size());
  for (const auto& [name, value] : health.counters) {
    message.counter_name.push_back(name);
    message.counter_value.push_back(value);
  }
  std::vector<Alarm> alarms = health.alarms;
  if (alarms.size() > kAlarms) {
    alarms.resize(kAlarms);
    alarms.push_back(alarm::more_alarms(health.alarms.size() - kAlarms));
  }
  set_alarms(alarms, message);
  message.last_error = health.last_error.substr(0, kLongestError);
  return message;
}

}  // namespace ols::fusion
