// Bus messages for the tests of the exports.
#pragma once

#include <algorithm>
#include <string>

#include "base/bus/bus_inbox.h"
#include "geometry/angles.h"
#include "geometry/wgs84.h"
#include "ols_msg/bearing_t.hpp"
#include "ols_msg/incident_t.hpp"
#include "ols_msg/station_status_t.hpp"
#include "ols_msg/target_t.hpp"
#include "tests/unit/export/made_records.h"
#include "tests/unit/on_the_bus.h"

namespace ols::exports {

inline ols_msg::target_t target_message() {
  auto message = made<ols_msg::target_t>();
  message.utime = kNow_us;
  message.boot_id = 3;
  message.target_id = 7;
  message.track_state = ols_msg::target_t::TRACK_CONFIRMED;
  message.latitude_deg = 47.5;
  message.height_m = 100.0;
  message.velocity_ecef_m_s[1] = 5.0;
  message.stations = 2;
  message.station = {"alfa", "bravo"};
  message.used = {1, 0};
  message.weight = message.age_s = {0.0, 0.0};
  return message;
}

inline ols_msg::station_status_t status_message() {
  auto message = made<ols_msg::station_status_t>();
  message.utime = kNow_us;
  message.station = "alfa";
  message.state = ols_msg::station_status_t::STATE_TRACKING;
  message.latitude_deg = 47.4;
  message.longitude_deg = 13.2;
  message.height_m = 600.0;
  message.azimuth_rad = 1.0;
  message.alarms = 1;
  message.alarm = {"camera: not there"};
  return message;
}

inline ols_msg::incident_t incident_message() {
  auto message = made<ols_msg::incident_t>();
  message.utime = message.begun_utime = kNow_us;
  message.number = 3;
  message.area = "Gate";
  message.target_boot_id = 3;
  message.target_id = 7;
  message.object_class = "drone";
  message.latitude_deg = 47.5;
  message.verdict = ols_msg::incident_t::VERDICT_DISMISSED;
  message.judged_by = "ana\n";
  message.stations = 1;
  message.station = {"alfa"};
  return message;
}

inline ols_msg::bearing_t bearing_message() {
  auto message = made<ols_msg::bearing_t>();
  message.utime = kNow_us;
  message.station = "alfa";
  message.belief = 0.9;
  const Eigen::Vector3d camera = ecef_from_geodetic({radians(47.4), radians(13.2), 601.0});
  std::copy(camera.data(), camera.data() + 3, message.camera_ecef_m);
  message.azimuth_rad = 1.5;
  message.covariance_white_rad2[0] = message.covariance_white_rad2[2] = 9e-8;
  message.covariance_systematic_rad2[0] = message.covariance_systematic_rad2[2] = 16e-8;
  return message;
}

}  // namespace ols::exports
