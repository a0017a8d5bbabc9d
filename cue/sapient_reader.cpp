#include "cue/sapient_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "export/sapient/sapient_messages.h"
#include "geometry/angles.h"
#include "geometry/utm.h"

namespace ols::cues {
namespace {

namespace sapient = exports::sapient;
using exports::sapient::DetectionReport;
using exports::sapient::Location;
using exports::sapient::RangeBearing;

constexpr double kEarth_m = 6.371e6;  // deviations need no ellipsoid

std::optional<std::int64_t> utime_of(const sapient::SapientMessage& message) {
  constexpr std::int64_t kLast_s = 253'402'300'799;  // of the year 9999
  const sapient::Timestamp& stamp = message.timestamp();
  const bool is_valid = message.has_timestamp() && stamp.seconds() >= 0 &&
                        stamp.seconds() <= kLast_s && stamp.nanos() >= 0 &&
                        stamp.nanos() < 1'000'000'000;
  if (!is_valid) return std::nullopt;
  return stamp.seconds() * 1'000'000 + stamp.nanos() / 1000;
}

template <class Informations>
bool has_own(const Informations& informations) {
  return std::ranges::any_of(
      informations, [](const auto& one) { return one.type().starts_with(exports::kSapientOwn); });
}

// By the standard, deviations have the units of their quantities, but some nodes write metres. From
// 1 on, they can only be metres. Less is read by the standard: at worst, the cue is too uncertain
// to be searched, but never more certain than its sensor.
std::optional<double> angular_sd_m(double error, double metres_per_unit) {
  constexpr double kMetres = 1.0;
  if (!std::isfinite(error) || error <= 0.0) return std::nullopt;
  return error >= kMetres ? error : error * metres_per_unit;
}

std::optional<double> larger(std::optional<double> a, std::optional<double> b) {
  return a && b ? std::optional(std::max(*a, *b)) : std::nullopt;
}

std::optional<double> positive(double value) {
  return std::isfinite(value) && value > 0.0 ? std::optional(value) : std::nullopt;
}

// "33N", "33S": its number and the hemisphere, as in the standard's examples; or "33U" with the
// latitude's band, of which N is the first in the north.
std::optional<Utm> grid_place(const Location& location, const std::string& zone) {
  Utm utm;
  const auto [end, bad] = std::from_chars(zone.data(), zone.data() + zone.size(), utm.zone);
  if (bad != std::errc{} || zone.data() + zone.size() - end != 1) return std::nullopt;
  const char band = *end >= 'a' ? static_cast<char>(*end - 'a' + 'A') : *end;
  if (band < 'C' || band > 'X') return std::nullopt;
  utm.northern = band >= 'N' && band != 'S';
  utm.easting_m = location.x();
  utm.northing_m = location.y();
  return utm;
}

std::optional<Refusal> set_on_grid(Report& report, const Location& location,
                                   const std::string& usual_zone) {
  const auto utm =
      grid_place(location, location.utm_zone().empty() ? usual_zone : location.utm_zone());
  if (!utm) return Refusal::kMalformed;
  try {
    const Geodetic there = geodetic_from_utm(*utm, 0.0);
    report.latitude_deg = degrees(there.latitude_rad);
    report.longitude_deg = degrees(there.longitude_rad);
  } catch (const std::invalid_argument&) {
    return Refusal::kOutOfRange;
  }
  report.horizontal_sd_m = larger(positive(location.x_error()), positive(location.y_error()));
  return std::nullopt;
}

// Latitude, longitude and their deviation; else why not.
std::optional<Refusal> set_on_map(Report& report, const Location& location,
                                  const std::string& usual_zone) {
  if (!location.has_x() || !location.has_y()) return Refusal::kMalformed;
  if (!std::isfinite(location.x() + location.y())) return Refusal::kNotFinite;
  const auto system = location.coordinate_system();
  if (system == sapient::LOCATION_COORDINATE_SYSTEM_UTM_M)
    return set_on_grid(report, location, usual_zone);
  const bool is_deg = system == sapient::LOCATION_COORDINATE_SYSTEM_LAT_LNG_DEG_M;
  if (!is_deg && system != sapient::LOCATION_COORDINATE_SYSTEM_LAT_LNG_RAD_M) {
    return Refusal::kMalformed;
  }
  const double unit_rad = is_deg ? kPi / 180.0 : 1.0;
  report.latitude_deg = degrees(location.y() * unit_rad);
  report.longitude_deg = degrees(location.x() * unit_rad);
  if (!(std::abs(report.latitude_deg) <= 90.0)) return Refusal::kOutOfRange;
  const double unit_m = unit_rad * kEarth_m;
  const double narrowing = std::cos(radians(report.latitude_deg));
  report.horizontal_sd_m = larger(angular_sd_m(location.x_error(), unit_m * narrowing),
                                  angular_sd_m(location.y_error(), unit_m));
  return std::nullopt;
}

struct Units {
  double to_rad = 1.0, to_m = 1.0;
};

std::optional<Units> units_of(const RangeBearing& sight) {
  constexpr double kDegree = kPi / 180.0, kKilometre_m = 1000.0;
  switch (sight.coordinate_system()) {
    case sapient::RANGE_BEARING_COORDINATE_SYSTEM_DEGREES_M:
      return Units{kDegree, 1.0};
    case sapient::RANGE_BEARING_COORDINATE_SYSTEM_RADIANS_M:
      return Units{1.0, 1.0};
    case sapient::RANGE_BEARING_COORDINATE_SYSTEM_DEGREES_KM:
      return Units{kDegree, kKilometre_m};
    case sapient::RANGE_BEARING_COORDINATE_SYSTEM_RADIANS_KM:
      return Units{1.0, kKilometre_m};
    default:
      return std::nullopt;
  }
}

// "lost", "lostInView": the report says where the target was, not where it is.
bool is_lost(const DetectionReport& report) {
  return report.state().starts_with("lost") || report.state().starts_with("Lost");
}

std::string label_of(const DetectionReport& report) {
  if (!report.id().empty()) return report.id();
  return report.classification_size() > 0 ? report.classification(0).type() : "";
}

}  // namespace

std::optional<Refusal> SapientReader::set_height(Report& report, const Location& location) const {
  if (!location.has_z()) return Refusal::kNoHeight;
  report.height_m = location.z();
  report.vertical_sd_m = positive(location.z_error());
  if (location.datum() == sapient::LOCATION_DATUM_WGS84_E) return std::nullopt;
  if (location.datum() != sapient::LOCATION_DATUM_WGS84_G || !geoid_m_) return Refusal::kNoHeight;
  const double geoid_m = geoid_m_(report.latitude_deg, report.longitude_deg);
  if (!std::isfinite(geoid_m)) return Refusal::kNoHeight;
  report.height_m += geoid_m;
  return std::nullopt;
}

std::optional<Refusal> SapientReader::place(Report& report, const Location& location,
                                            const Node& from) const {
  const auto refusal = set_on_map(report, location, from.utm_zone);
  return refusal ? refusal : set_height(report, location);
}

// Along a straight line from the node, whose place its status reports say.
std::optional<Refusal> SapientReader::place(Report& report, const RangeBearing& sight,
                                            const Node& from) {
  const auto units = units_of(sight);
  if (!units || sight.datum() != sapient::RANGE_BEARING_DATUM_TRUE) return Refusal::kOtherType;
  if (!from.place || !sight.has_azimuth() || !sight.has_range()) return Refusal::kOtherType;
  if (!sight.has_elevation()) return Refusal::kNoHeight;
  const double azimuth = sight.azimuth() * units->to_rad;
  const double elevation = sight.elevation() * units->to_rad;
  const double range_m = sight.range() * units->to_m;
  constexpr double kFarthest_m = 1e6;
  if (!std::isfinite(azimuth + elevation)) return Refusal::kNotFinite;
  if (!(range_m >= 0.0 && range_m <= kFarthest_m)) return Refusal::kOutOfRange;
  const Eigen::Vector3d enu =
      range_m * Eigen::Vector3d(std::cos(elevation) * std::sin(azimuth),
                                std::cos(elevation) * std::cos(azimuth), std::sin(elevation));
  const Geodetic there = geodetic_from_ecef(LocalFrame(*from.place).to_ecef(enu));
  report.latitude_deg = degrees(there.latitude_rad);
  report.longitude_deg = degrees(there.longitude_rad);
  report.height_m = there.height_m;
  const double ground_m = range_m * std::cos(elevation);
  const double to_rad = units->to_rad;
  report.horizontal_sd_m = larger(positive(sight.range_error() * units->to_m),
                                  positive(sight.azimuth_error() * to_rad * ground_m));
  report.vertical_sd_m = positive(sight.elevation_error() * to_rad * range_m);
  return std::nullopt;
}

Reading SapientReader::reading_of(const DetectionReport& detection, const std::string& node,
                                  std::int64_t utime_us) const {
  Report report;
  report.name = detection.object_id();
  report.label = label_of(detection);
  report.utime_us = utime_us;
  if (report.name.empty()) return Refused{Refusal::kMalformed, "a detection without an object"};
  if (has_own(detection.track_info()) || has_own(detection.object_info())) {
    return Refused{Refusal::kOwn, report.name};
  }
  const auto found = nodes_.find(node);
  const Node from = found == nodes_.end() ? Node{} : found->second;
  std::optional<Refusal> refusal = Refusal::kMalformed;
  if (detection.has_location()) refusal = place(report, detection.location(), from);
  if (detection.has_range_bearing()) refusal = place(report, detection.range_bearing(), from);
  if (refusal) return Refused{*refusal, report.name};
  if (detection.has_enu_velocity()) {
    const auto& velocity = detection.enu_velocity();
    const double unit_m_s = from.speed_unit_m_s;
    report.velocity_enu_m_s = {velocity.east_rate() * unit_m_s, velocity.north_rate() * unit_m_s,
                               velocity.up_rate() * unit_m_s};
    report.velocity_sd_m_s = larger(positive(velocity.east_rate_error() * unit_m_s),
                                    positive(velocity.north_rate_error() * unit_m_s));
  }
  return report;
}

void SapientReader::note_registration(Node& node, const sapient::Registration& registration) {
  constexpr double kKilometreAnHour_m_s = 1.0 / 3.6;
  constexpr std::size_t kLongestZone = 3;
  for (const auto& mode : registration.mode_definition()) {
    for (const auto& detections : mode.detection_definition()) {
      const auto& units = detections.velocity_type().enu_velocity_units();
      const auto unit = units.east_north_rate_units();
      if (unit != sapient::SPEED_UNITS_UNSPECIFIED) {
        node.speed_unit_m_s = unit == sapient::SPEED_UNITS_KPH ? kKilometreAnHour_m_s : 1.0;
      }
      const std::string zone = detections.location_type().zone().substr(0, kLongestZone);
      if (!zone.empty()) node.utm_zone = zone;
    }
  }
}

// If a place cannot be used, none is known: the node may be far from the previous one.
void SapientReader::note_place(Node& node, const sapient::Location& where) {
  Report at;
  node.place.reset();
  if (place(at, where, node) || !std::isfinite(at.height_m)) return;
  node.place = Geodetic{radians(at.latitude_deg), radians(at.longitude_deg), at.height_m};
}

// Null: too many nodes. A newcomer must not push out a known one.
SapientReader::Node* SapientReader::node(const std::string& id) {
  const auto known = nodes_.find(id);
  if (known != nodes_.end()) return &known->second;
  return nodes_.size() < kMost ? &nodes_[id] : nullptr;
}

Readings SapientReader::take(const std::string& message) {
  sapient::SapientMessage said;
  if (!said.ParseFromString(message)) return {Refused{Refusal::kMalformed, "no SAPIENT"}};
  // What is kept of nodes must stay small, whatever they call themselves.
  constexpr std::size_t kLongestName = 64;
  if (said.node_id().size() > kLongestName) return {Refused{Refusal::kMalformed, "a node's name"}};
  if (said.has_registration()) {
    Node* sender = node(said.node_id());
    if (!sender) return {Refused{Refusal::kMalformed, "a node too many"}};
    note_registration(*sender, said.registration());
  } else if (said.has_status_report() && said.status_report().has_node_location()) {
    Node* sender = node(said.node_id());
    if (!sender) return {Refused{Refusal::kMalformed, "a node too many"}};
    note_place(*sender, said.status_report().node_location());
  } else if (said.has_detection_report()) {
    const auto utime_us = utime_of(said);
    if (!utime_us) return {Refused{Refusal::kMalformed, "a message without a time"}};
    if (is_lost(said.detection_report())) return {};
    return {reading_of(said.detection_report(), said.node_id(), *utime_us)};
  }
  return {};
}

}  // namespace ols::cues
