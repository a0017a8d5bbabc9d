#include "tools/calibrate/calibrate_case.h"

#include <algorithm>
#include <cmath>

#include "base/calibration_csv.h"
#include "geometry/angles.h"
#include "geometry/utm.h"
#include "tools/calibrate/observation_file.h"

namespace ols::calibration {
namespace {

StationPrior prior_of(const station::StationSettings& settings, const Instrument& instrument,
                      const std::string& path) {
  if (!settings.pose.surveyed_position) {
    throw std::invalid_argument(path + ": pose.latitude_deg: is needed");
  }
  StationPrior prior;
  prior.model = with_instrument(settings.station.geometry, instrument);
  prior.pose_sd_rad = instrument.angle_sd_rad;
  StationMatrix& C = prior.covariance;
  C.topLeftCorner<kInstrumentParameters, kInstrumentParameters>() = instrument.covariance;
  const CalibrationSd& sd = settings.station.geometry.sd;
  const double tilt_sd_rad =
      settings.pose.surveyed_tilt_rad ? sd.tilt_rad : settings.pose.level_sd_rad;
  for (const int k : {kTiltX, kTiltY}) C(k, k) = tilt_sd_rad * tilt_sd_rad;
  for (const int k : {kEast, kNorth, kUp}) C(k, k) = sd.position_m * sd.position_m;
  for (const int k : {kRefraction, kAir}) {
    C(k, k) = std::pow(parameter_texts()[static_cast<std::size_t>(k)].new_unit_sd, 2);
  }
  return prior;
}

Eigen::Vector3d place_of(const ReferenceRow& row, const std::string& path) {
  if (const auto* place = std::get_if<GeodeticCells>(&row.place)) {
    return ecef_from_geodetic(
        {radians(place->latitude_deg), radians(place->longitude_deg), row.height_m});
  }
  const auto& utm = std::get<UtmCells>(row.place);
  try {
    return ecef_from_geodetic(
        geodetic_from_utm({utm.zone, utm.northern, utm.easting_m, utm.northing_m}, row.height_m));
  } catch (const std::invalid_argument& error) {
    throw CsvError(path + ":" + std::to_string(row.line) + ": easting_m: " + error.what());
  }
}

Star star_of(const StarCells& cells) {
  constexpr double kMas_rad = kPi / 648000e3;
  return {radians(cells.ra_deg), radians(cells.dec_deg), cells.pm_ra_mas_yr * kMas_rad,
          cells.pm_dec_mas_yr * kMas_rad, 1e-3 * cells.parallax_mas};
}

References references_of(const std::string& path) {
  References references;
  if (path.empty()) return references;
  for (const ReferenceRow& row : read_references(path)) {
    if (row.star) {
      references[row.name] = star_of(*row.star);
    } else if (!row.utime_us) {
      references[row.name] = FixedPoint{place_of(row, path), row.sd_m};
    } else {
      auto& entry = references.try_emplace(row.name, Trajectory{}).first->second;
      auto& trajectory = std::get<Trajectory>(entry);
      trajectory.points.push_back({*row.utime_us, place_of(row, path)});
      trajectory.sd_m = std::max(trajectory.sd_m, row.sd_m);
    }
  }
  for (const auto& [name, reference] : references) {
    const auto* trajectory = std::get_if<Trajectory>(&reference);
    if (trajectory && trajectory->points.size() < 2) {
      throw CsvError(path + ": '" + name + "' has a single position in time");
    }
  }
  return references;
}

void read_stations(const CaseOptions& options, Case& what) {
  for (std::size_t i = 0; i < options.stations.size(); ++i) {
    const auto settings = station::load_station_settings(options.stations[i]);
    Problem& problem = what.problem;
    if (std::ranges::find(problem.names, settings.id) != problem.names.end()) {
      throw std::invalid_argument("--station: '" + settings.id + "' is given twice");
    }
    Instrument instrument = new_instrument(settings);
    if (!options.instruments.empty()) {
      instrument = read_instrument(options.instruments[i], instrument);
      check_serials(settings.serials, instrument.serials, options.instruments[i]);
    }
    problem.names.push_back(settings.id);
    problem.stations.push_back(prior_of(settings, instrument, options.stations[i]));
    what.instruments.push_back(instrument);
  }
}

void read_sky(const CaseOptions& options, Case& what) {
  constexpr double kStatedUt1_s = 1e-3;
  Problem& problem = what.problem;
  if (options.ut1_minus_utc_s) {
    problem.earth.ut1_minus_utc_s = *options.ut1_minus_utc_s;
    problem.ut1_sd_s = kStatedUt1_s;
  }
  if (options.pressure_hPa || options.temperature_degC) {
    Air air = standard_air(problem.stations.front().model.geometry.position.height_m);
    air.pressure_hPa = options.pressure_hPa.value_or(air.pressure_hPa);
    air.temperature_degC = options.temperature_degC.value_or(air.temperature_degC);
    problem.air = air;
  }
  const bool sky = std::ranges::any_of(problem.observations, [](const Observation& one) {
    return one.kind == Kind::kStar || one.kind == Kind::kSun;
  });
  if (!sky) return;
  if (!options.ut1_minus_utc_s) {
    what.warnings.emplace_back(
        "UT1 - UTC is not stated (--ut1-utc): taken as 0 with a deviation of 0.3 s, 4.5 arc "
        "seconds of heading");
  }
  if (!problem.air) {
    what.warnings.emplace_back(
        "the air is not stated (--pressure, --temperature): taken as the standard atmosphere");
  }
}

}  // namespace

Case read_case(const CaseOptions& options) {
  if (!options.instruments.empty() && options.instruments.size() != options.stations.size()) {
    throw std::invalid_argument("--instrument: is needed for every --station, or for none");
  }
  Case what;
  what.options = options;
  read_stations(options, what);
  for (const std::string& path : options.observations) {
    for (const Observation& one : read_observations(path, what.problem.names)) {
      what.problem.observations.push_back(one);
      what.files.push_back(path);
    }
  }
  what.problem.references = references_of(options.references);
  read_sky(options, what);
  return what;
}

Network network_of(const Case& what) {
  try {
    return network_of(what.problem);
  } catch (const ObservationRefused& refused) {
    const auto& all = what.problem.observations;
    std::size_t i = 0;
    while (i + 1 < all.size() && all[i].line != refused.line()) ++i;
    throw std::runtime_error(what.files[i] + ":" + std::to_string(refused.line()) + ": " +
                             refused.what());
  }
}

}  // namespace ols::calibration
