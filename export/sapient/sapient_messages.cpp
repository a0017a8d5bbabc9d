#include "export/sapient/sapient_messages.h"

#include <cmath>

#include "export/sapient/frame.h"
#include "export/sapient/identifiers.h"
#include "export/text.h"
#include "export/uncertainty.h"
#include "geometry/angles.h"
#include "geometry/wgs84.h"
#include "sapient/sapient.pb.h"

namespace ols::exports {
namespace {

using sapient::DetectionReport;
using sapient::Location;
using sapient::SapientMessage;
using sapient::StatusReport;

constexpr double kSecond_us = 1e6;

std::string report_id(std::int64_t utime_us, const std::string& what) {
  return ulid_of(utime_us / 1000, what + " " + std::to_string(utime_us));
}

void set_place(Location& location, double latitude_deg, double longitude_deg, double height_m) {
  location.set_x(longitude_deg);
  location.set_y(latitude_deg);
  location.set_z(height_m);
  location.set_coordinate_system(sapient::LOCATION_COORDINATE_SYSTEM_LAT_LNG_DEG_M);
  location.set_datum(sapient::LOCATION_DATUM_WGS84_E);
}

// The length of a degree at a place.
struct Degree {
  double east_m = 0.0, north_m = 0.0;
};

Degree degree_at(const Place& place) {
  constexpr double kStep_deg = 1e-4;
  const auto ecef = [&](double latitude_deg, double longitude_deg) {
    return ecef_from_geodetic({radians(latitude_deg), radians(longitude_deg), place.height_m});
  };
  const auto here = ecef(place.latitude_deg, place.longitude_deg);
  return {(ecef(place.latitude_deg, place.longitude_deg + kStep_deg) - here).norm() / kStep_deg,
          (ecef(place.latitude_deg + kStep_deg, place.longitude_deg) - here).norm() / kStep_deg};
}

// Deviations have the units of their quantities: degrees, degrees, metres.
void set_errors(Location& location, const Covariance& enu, const Degree& degree) {
  const double east_m = sd(enu[0]), north_m = sd(enu[3]), up_m = sd(enu[5]);
  if (std::isfinite(east_m) && degree.east_m > 0.0) location.set_x_error(east_m / degree.east_m);
  if (std::isfinite(north_m)) location.set_y_error(north_m / degree.north_m);
  if (std::isfinite(up_m)) location.set_z_error(up_m);
}

// Where the target is at another instant, some hundredths of a second away.
Place moved(const Target& target, const Degree& degree, double seconds) {
  Place place = target.place;
  const auto& [east, north, up] = target.velocity_enu_m_s;
  if (!std::isfinite(east + north + up) || degree.east_m <= 0.0) return place;
  place.latitude_deg += seconds * north / degree.north_m;
  place.longitude_deg =
      degrees(wrap_pi(radians(place.longitude_deg + seconds * east / degree.east_m)));
  place.height_m += seconds * up;
  return place;
}

void set_velocity(DetectionReport& report, const Target& target) {
  const auto& [east, north, up] = target.velocity_enu_m_s;
  if (!std::isfinite(east + north + up)) return;
  auto& velocity = *report.mutable_enu_velocity();
  velocity.set_east_rate(east);
  velocity.set_north_rate(north);
  velocity.set_up_rate(up);
  const Covariance& variances = target.velocity_covariance_m2_s2;
  const double east_sd = sd(variances[0]), north_sd = sd(variances[3]), up_sd = sd(variances[5]);
  if (std::isfinite(east_sd)) velocity.set_east_rate_error(east_sd);
  if (std::isfinite(north_sd)) velocity.set_north_rate_error(north_sd);
  if (std::isfinite(up_sd)) velocity.set_up_rate_error(up_sd);
}

void add_information(DetectionReport& report, const std::string& type, const std::string& value) {
  if (value.empty()) return;
  auto& information = *report.add_track_info();
  information.set_type(kSapientOwn + type);
  information.set_value(value);
}

std::string numbers_of(const Covariance& covariance) {
  std::string text;
  for (const double value : covariance) {
    const std::string number = fixed(value, 4);
    if (number.empty()) return {};
    text.append(text.empty() ? "" : " ").append(number);
  }
  return text;
}

std::string names_of(const Target& target) {
  std::string names;
  for (const std::string& station : target.stations) {
    names.append(names.empty() ? "" : " ").append(station);
  }
  return names;
}

Place middle_of(const std::vector<Station>& stations) {
  const Place& first = stations.front().place;
  const auto count = static_cast<double>(stations.size());
  double latitude_deg = 0.0, beyond_deg = 0.0, height_m = 0.0;
  for (const Station& station : stations) {
    latitude_deg += station.place.latitude_deg / count;
    beyond_deg += std::remainder(station.place.longitude_deg - first.longitude_deg, 360.0) / count;
    height_m += station.place.height_m / count;
  }
  const double longitude_deg = std::remainder(first.longitude_deg + beyond_deg, 360.0);
  return {latitude_deg, longitude_deg, height_m, kUnknown};
}

void add_status(StatusReport& report, bool is_well, StatusReport::StatusType type,
                const std::string& words) {
  auto& status = *report.add_status();
  status.set_status_level(is_well ? StatusReport::STATUS_LEVEL_INFORMATION_STATUS
                                  : StatusReport::STATUS_LEVEL_WARNING_STATUS);
  status.set_status_type(type);
  status.set_status_value(words);
}

void add_station(StatusReport& report, const Station& station) {
  std::string words = station.name + ": " + station.state;
  if (station.alarms > 0)
    words.append(", ").append(std::to_string(station.alarms)).append(" alarms");
  if (!station.clock_is_good) words.append(", clock not synchronised");
  const bool is_well = station.is_well && station.clock_is_good;
  add_status(report, is_well,
             is_well ? StatusReport::STATUS_TYPE_OTHER : StatusReport::STATUS_TYPE_INTERNAL_FAULT,
             words);
  if (!is_well) report.set_system(StatusReport::SYSTEM_WARNING);
}

// Each report is a new one: a heartbeat that says everything fits whatever its receiver knows.
StatusReport& begin_report(SapientMessage& message, const SapientSettings& settings,
                           const char* kind, std::int64_t utime_us) {
  StatusReport& report = *message.mutable_status_report();
  report.set_report_id(report_id(utime_us, settings.site + "." + kind));
  report.set_info(StatusReport::INFO_NEW);
  report.set_mode("Default");
  return report;
}

}  // namespace

std::string sapient_status(const SapientSettings& settings, const std::vector<Station>& stations,
                           std::int64_t utime_us) {
  SapientMessage message = message_of(settings, utime_us);
  StatusReport& report = begin_report(message, settings, "status", utime_us);
  report.set_system(StatusReport::SYSTEM_OK);
  if (stations.empty()) {
    report.set_system(StatusReport::SYSTEM_WARNING);
    add_status(report, false, StatusReport::STATUS_TYPE_NOT_DETECTING, "no station is heard");
  } else {
    const Place middle = middle_of(stations);
    set_place(*report.mutable_node_location(), middle.latitude_deg, middle.longitude_deg,
              middle.height_m);
  }
  for (const Station& station : stations) add_station(report, station);
  return framed(message.SerializeAsString());
}

std::string sapient_goodbye(const SapientSettings& settings, std::int64_t utime_us) {
  SapientMessage message = message_of(settings, utime_us);
  begin_report(message, settings, "goodbye", utime_us).set_system(StatusReport::SYSTEM_GOODBYE);
  return framed(message.SerializeAsString());
}

std::string sapient_detection(const SapientSettings& settings, const Target& target,
                              std::int64_t stamp_us) {
  SapientMessage message = message_of(settings, stamp_us);
  DetectionReport& report = *message.mutable_detection_report();
  const std::string state = to_string(target.state);
  report.set_report_id(
      ulid_of(stamp_us / 1000, target.uid + " " + state + " " + std::to_string(target.utime_us)));
  report.set_object_id(ulid_of(0, target.uid));
  if (target.state == TrackState::kEnded) report.set_state("lost");
  const Degree degree = degree_at(target.place);
  const double later_s = static_cast<double>(stamp_us - target.utime_us) / kSecond_us;
  const Place place = moved(target, degree, later_s);
  Location& location = *report.mutable_location();
  set_place(location, place.latitude_deg, place.longitude_deg, place.height_m);
  set_errors(location, target.covariance_m2, degree);
  set_velocity(report, target);
  add_information(report, "state", state);
  add_information(report, "stations", names_of(target));
  add_information(report, "covariance_enu_m2", numbers_of(target.covariance_m2));
  add_information(report, "velocity_covariance_enu_m2_s2",
                  numbers_of(target.velocity_covariance_m2_s2));
  auto& classification = *report.add_classification();
  classification.set_type(standard_class(target.object_class));
  if (std::isfinite(target.class_probability)) {
    classification.set_confidence(static_cast<float>(target.class_probability));
  }
  report.set_id(callsign(target));
  return framed(message.SerializeAsString());
}

std::string sapient_task_refusal(const SapientSettings& settings, const std::string& task_id,
                                 const std::string& to, std::int64_t utime_us) {
  SapientMessage message = message_of(settings, utime_us);
  message.set_destination_id(to);
  auto& answer = *message.mutable_task_ack();
  answer.set_task_id(task_id);
  answer.set_task_status(sapient::TaskAck::TASK_STATUS_REJECTED);
  answer.add_reason("this node reports and takes no tasks");
  return framed(message.SerializeAsString());
}

}  // namespace ols::exports
