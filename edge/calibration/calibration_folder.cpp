#include "edge/calibration/calibration_folder.h"

#include <cmath>
#include <stdexcept>

#include "base/config/config_section.h"
#include "base/files/fnv1a.h"
#include "base/files/small_file.h"
#include "calibration/systematic.h"
#include "edge/calibration/covariance_file.h"
#include "edge/calibration/instrument_file.h"
#include "edge/config/config_units.h"

namespace ols::station {
namespace {

using config::number;

constexpr std::size_t kMost_bytes = 1 << 20;
constexpr std::string_view kIdKey = "\ncalibration_id = ";

// setup.toml.
struct Setup {
  std::string station;
  std::int64_t id = 0, observed_utime_us = 0;
  Geodetic position;
  double heading_rad = 0.0, tilt_x_rad = 0.0, tilt_y_rad = 0.0;
  double refraction_k = 0.13, air = 1.0;
};

config::Section setup_section(Setup& s) {
  const auto angle = [](const char* key, double& field_rad, double limit_deg, const char* what) {
    return number(key, field_rad, {-limit_deg, limit_deg}, in_degrees(), what).required();
  };
  return {"",
          "",
          {config::integer("calibration_id", s.id, 1, INT64_MAX, "", "By the content.").required(),
           config::text("station", s.station, "The station's id.").required(),
           config::integer("observed_utime_us", s.observed_utime_us, 0, INT64_MAX, "us",
                           "UTC of the last observation.")},
          {{"pose",
            "How the tripod stands.",
            {angle("latitude_deg", s.position.latitude_rad, 90.0, "WGS84 latitude."),
             angle("longitude_deg", s.position.longitude_rad, 360.0, "WGS84 longitude."),
             number("height_m", s.position.height_m, {-1000.0, 100000.0}, "m",
                    "Height above the ellipsoid.")
                 .required(),
             angle("heading_deg", s.heading_rad, 360.0, "Direction of zero pan."),
             angle("tilt_x_deg", s.tilt_x_rad, 90.0, "Inclination about X."),
             angle("tilt_y_deg", s.tilt_y_rad, 90.0, "Inclination about Y.")}},
           {"air",
            "The air at the observations.",
            {number("refraction_k", s.refraction_k, {-10.0, 10.0}, "",
                    "Coefficient of terrestrial refraction."),
             number("air", s.air, {0.0, 10.0}, "", "Factor of the astronomical refraction.")}}}};
}

Setup read_setup(const std::string& path, const std::string& station) {
  Setup setup;
  ConfigFile file(path);
  config::read(setup_section(setup), file.root());
  if (setup.station != station) {
    throw file.root().error("station", "is '" + setup.station + "', this is '" + station + "'");
  }
  return setup;
}

std::string in(const std::string& folder, const char* name) { return folder + "/" + name; }

void check_content(const std::string& folder, std::int64_t id) {
  const std::string setup = read_small_file(in(folder, "setup.toml"), kMost_bytes);
  const std::size_t key = setup.find(kIdKey);
  const std::size_t end = key == std::string::npos ? key : setup.find('\n', key + kIdKey.size());
  const std::string_view rest =
      end == std::string::npos ? std::string_view() : std::string_view(setup).substr(end + 1);
  const std::int64_t found =
      calibration_id_of(read_small_file(in(folder, "instrument.toml"), kMost_bytes), rest,
                        read_small_file(in(folder, "covariance.csv"), kMost_bytes));
  if (found == id) return;
  throw std::invalid_argument(in(folder, "setup.toml") +
                              ": calibration_id: is not that of the content: a file of the folder "
                              "was changed or exchanged");
}

ModelParameters setup_change(const StationGeometry& from, const Setup& to) {
  ModelParameters by = ModelParameters::Zero();
  by[kHeading] = to.heading_rad - from.chain.heading_rad;
  by[kTiltX] = to.tilt_x_rad - from.chain.tilt_x_rad;
  by[kTiltY] = to.tilt_y_rad - from.chain.tilt_y_rad;
  return by;
}

}  // namespace

std::int64_t calibration_id_of(std::string_view instrument, std::string_view setup,
                               std::string_view covariance) {
  return static_cast<std::int64_t>(fnv1a(covariance, fnv1a(setup, fnv1a(instrument))) >> 1);
}

CalibrationFiles read_calibration(const std::string& folder, const StationSettings& settings) {
  const Setup setup = read_setup(in(folder, "setup.toml"), settings.id);
  const std::string instrument_path = in(folder, "instrument.toml");
  const auto instrument =
      calibration::read_instrument(instrument_path, calibration::new_instrument(settings));
  calibration::check_serials(settings.serials, instrument.serials, instrument_path);
  const calibration::StationMatrix covariance =
      calibration::read_station_covariance(in(folder, "covariance.csv"));
  check_content(folder, setup.id);
  CalibrationFiles files;
  StationCalibration& c = files.calibration;
  const StationGeometry& configured = settings.station.geometry;
  c.model = changed(calibration::with_instrument(configured, instrument),
                    setup_change(configured, setup));
  c.model.geometry.position = setup.position;
  c.covariance = covariance.topLeftCorner<kModelParameters, kModelParameters>();
  c.angle_sd_rad = instrument.angle_sd_rad;
  const auto volume = calibration::volume_precision(c.model, covariance);
  files.rms_rad = volume.rms_rad;
  files.worst_rad = volume.worst_rad;
  // For whoever needs one number: how well a direction is known.
  CalibrationSd& sd = c.model.geometry.sd;
  sd = {};
  sd.heading_rad = sd.tilt_rad = volume.rms_rad;
  sd.position_m = std::sqrt(c.covariance.diagonal().segment<3>(kEast).mean());
  files.serials = instrument.serials;
  files.id = setup.id;
  files.observed_utime_us = setup.observed_utime_us;
  return files;
}

StationSettings with_calibration(StationSettings settings, const CalibrationFiles& files) {
  const StationGeometry& geometry = files.calibration.model.geometry;
  settings.calibration_id = files.id;
  settings.station.geometry = geometry;
  settings.station.calibration = files.calibration;
  settings.pose.surveyed_position = geometry.position;
  settings.pose.surveyed_position_sd_m = geometry.sd.position_m;
  settings.pose.surveyed_tilt_rad =
      Eigen::Vector2d(geometry.chain.tilt_x_rad, geometry.chain.tilt_y_rad);
  settings.pose.surveyed_tilt_sd_rad = geometry.sd.tilt_rad;
  return settings;
}

}  // namespace ols::station
