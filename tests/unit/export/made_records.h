// Records for the tests of the exports. The target is 100 m above the ellipsoid; the geoid there is
// 46 m above the ellipsoid.
#pragma once

#include "export/records.h"

namespace ols::exports {

inline constexpr std::int64_t kNow_us = 1'700'000'000'123'000;  // 2023-11-14T22:13:20.123Z

inline Target made_target(std::int64_t id = 7, std::int64_t after_us = 0) {
  Target target;
  target.utime_us = kNow_us + after_us;
  target.uid = "site.target.a." + std::to_string(id);
  target.id = id;
  target.place = {47.5, 13.25, 100.0, 46.0};
  target.covariance_m2 = {4.0, 1.0, 0.0, 9.0, 0.0, 25.0};
  target.velocity_enu_m_s = {3.0, 4.0, -1.5};
  target.velocity_covariance_m2_s2 = {0.25, 0.0, 0.0, 0.25, 0.0, 1.0};
  target.stations = {"alfa", "bravo"};
  target.above_ground_m = 12.26;
  target.above_ground_sd_m = 1.51;
  return target;
}

inline Station made_station() {
  Station station;
  station.utime_us = kNow_us;
  station.uid = "site.station.alfa";
  station.name = "alfa";
  station.place = {47.4, 13.2, 600.0, 46.0};
  station.position_sd_m = {0.5, 0.75, 2.0};
  station.azimuth_deg = 123.5;
  station.elevation_deg = 4.25;
  station.field_of_view_deg = {2.0, 1.5};
  station.state = "tracking";
  return station;
}

inline Line made_line(std::int64_t after_us = 0) {
  Line line;
  line.utime_us = kNow_us + after_us;
  line.uid = "site.line.alfa";
  line.station = "alfa";
  line.camera = {47.4, 13.2, 601.0, 46.0};
  line.azimuth_deg = 90.0;
  line.elevation_deg = 2.0;
  line.cross_sd_deg = 0.01;
  line.elevation_sd_deg = 0.02;
  line.belief = 0.9;
  line.track_id = 3;
  return line;
}

inline Incident made_incident() {
  Incident incident;
  incident.utime_us = incident.begun_us = kNow_us;
  incident.uid = "site.incident.3.1";
  incident.number = 3;
  incident.area = "Gate <1>";
  incident.target_id = 7;
  incident.target_uid = "site.target.a.7";
  incident.object_class = "drone";
  incident.class_probability = 0.9;
  incident.place = {47.5, 13.25, 100.0, 46.0};
  incident.verdict = "open";
  incident.stations = {"alfa"};
  return incident;
}

}  // namespace ols::exports
