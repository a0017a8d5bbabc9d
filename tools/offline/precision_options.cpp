#include "tools/offline/precision_options.h"

#include "geometry/angles.h"

namespace ols::offline {

void add_measurement_options(CLI::App& app, MeasurementOptions& o) {
  const auto add = [&app](const char* name, double& value, const char* text, double least,
                          double greatest) {
    app.add_option(name, value, text)
        ->check(CLI::Range(least, greatest))
        ->capture_default_str()
        ->group("How well the stations measure (1-sigma)");
  };
  add("--pixel-sd", o.pixel_sd_px, "[px] of the tracker, new with every exposure", 1e-3, 1e3);
  add("--pixel-um", o.pixel_um, "[um] size of a pixel", 0.1, 100.0);
  add("--focal-length-mm", o.focal_length_mm, "[mm]", 0.1, 1e4);
  add("--heading-sd-deg", o.heading_sd_deg, "[deg] stays from frame to frame", 0.0, 90.0);
  add("--tilt-sd-deg", o.tilt_sd_deg, "[deg] of each axis, stays", 0.0, 90.0);
  add("--mounting-sd-deg", o.mounting_sd_deg, "[deg] of the camera on the unit, stays", 0.0, 90.0);
  add("--position-sd-m", o.position_sd_m, "[m] of each axis, stays", 0.0, 1e4);
  add("--clock-sd-ms", o.clock_sd_ms, "[ms] stays; counts with --speed", 0.0, 1e5);
  add("--speed", o.speed_m_s, "[m/s] of the target, in any direction", 0.0, 1e5);
  add("--exposures", o.exposures, "exposures that are averaged; systematic errors are not reduced",
      1.0, 1e9);
}

PlannedStation planned_station(const Geodetic& place, const MeasurementOptions& o) {
  PlannedStation station;
  station.place = LocalFrame(place);
  station.white_rad = o.pixel_sd_px * o.pixel_um * 1e-6 / (o.focal_length_mm * 1e-3);
  station.calibration.heading_rad = radians(o.heading_sd_deg);
  station.calibration.tilt_rad = radians(o.tilt_sd_deg);
  station.calibration.mount_rad = radians(o.mounting_sd_deg);
  station.calibration.position_m = o.position_sd_m;
  station.clock_sd_s = 1e-3 * o.clock_sd_ms;
  return station;
}

PlannedStation planned_station(const StationRow& row, const MeasurementOptions& options) {
  PlannedStation station = planned_station(
      Geodetic{radians(row.latitude_deg), radians(row.longitude_deg), row.height_m}, options);
  if (row.position_sd_m) station.calibration.position_m = *row.position_sd_m;
  if (row.pointing_sd_deg) {
    station.calibration.heading_rad = station.calibration.tilt_rad = 0.0;
    station.calibration.mount_rad = radians(*row.pointing_sd_deg);
  }
  return station;
}

std::vector<PlannedStation> planned_stations(const std::vector<StationRow>& rows,
                                             const MeasurementOptions& options) {
  std::vector<PlannedStation> stations;
  for (const StationRow& row : rows) stations.push_back(planned_station(row, options));
  return stations;
}

PlannedTarget planned_target(const Geodetic& place, const MeasurementOptions& o) {
  return {ecef_from_geodetic(place), o.speed_m_s * o.speed_m_s / 3.0 * Eigen::Matrix3d::Identity()};
}

}  // namespace ols::offline
