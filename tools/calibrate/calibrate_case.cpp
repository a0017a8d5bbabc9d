#include "tools/calibrate/calibrate_case.h"

#include <algorithm>
#include <cmath>

#include "calibration/mistaken_sightings.h"
#include "calibration/name_stars.h"
#include "calibration/procedure/preconditions.h"
#include "geometry/angles.h"
#include "tools/calibrate/calibration_csv.h"
#include "tools/calibrate/observation_file.h"
#include "tools/calibrate/surveyed_place.h"

namespace ols::calibration {
namespace {

// A stepper of 0.9 degrees behind a worm: a step is a whole fraction of a turn of the worm, so the
// exact resolution follows from the rounded one that a unit prints.
void set_resolution(Instrument& instrument, double resolution_arcsec) {
  constexpr double kTurn_arcsec = 1296000.0;
  constexpr int kStepsOfMotor = 400;
  for (AxisModel* axis : {&instrument.pan, &instrument.tilt}) {
    const std::int64_t full_steps = std::int64_t{axis->worm_teeth} * kStepsOfMotor;
    const double exact = kTurn_arcsec / resolution_arcsec;
    const auto counts =
        std::llround(exact * 16.0 / static_cast<double>(full_steps)) * full_steps / 16;
    constexpr double kPrinted = 1e-4;  // six digits
    if (counts <= 0 || std::abs(exact / static_cast<double>(counts) - 1.0) > kPrinted) {
      throw std::invalid_argument(
          "--resolution: is no whole fraction of a motor's step of 0.9 degrees behind a worm of " +
          std::to_string(axis->worm_teeth) +
          " teeth: state the counts of a turn in the instrument ([unit])");
    }
    axis->counts_per_turn = counts;
  }
}

Star star_of(const StarCells& cells) {
  constexpr double kMas_rad = kPi / 648000e3;
  return {radians(cells.ra_deg), radians(cells.dec_deg), cells.pm_ra_mas_yr * kMas_rad,
          cells.pm_dec_mas_yr * kMas_rad, 1e-3 * cells.parallax_mas};
}

// The air is that of the first station.
void check_pressure(double pressure_hPa, const Problem& problem) {
  const std::string trouble =
      pressure_trouble(pressure_hPa, problem.stations.front().model.geometry.position.height_m);
  if (trouble.empty()) return;
  throw std::invalid_argument("--pressure: station '" + problem.names.front() + "': " + trouble);
}

void read_sky(const CaseOptions& options, Case& what) {
  Problem& problem = what.problem;
  if (options.pressure_hPa || options.temperature_degC) {
    Air air = standard_air(problem.stations.front().model.geometry.position.height_m);
    air.pressure_hPa = options.pressure_hPa.value_or(air.pressure_hPa);
    air.temperature_degC = options.temperature_degC.value_or(air.temperature_degC);
    problem.air = air;
  }
  const auto sky = std::ranges::find_if(problem.observations, [](const Observation& one) {
    return one.kind == Kind::kStar || one.kind == Kind::kSun;
  });
  if (sky == problem.observations.end()) return;
  if (options.pressure_hPa) check_pressure(*options.pressure_hPa, problem);
  problem.earth.ut1_minus_utc_s = options.ut1.minus_utc_s.value_or(0.0);
  problem.ut1_sd_s =
      std::hypot(ut1_sd_s(options.ut1, sky->utime_us), options.clock_sd_s.value_or(kClockOfSky_s));
  if (!options.clock_sd_s) {
    what.warnings.emplace_back(
        "the error of the clock is not stated (--clock-sd): taken as 0.05 s; each second turns "
        "the sky by 15 arc seconds, which no star contradicts");
  }
  const std::string remark = ut1_remark(options.ut1, sky->utime_us);
  if (!remark.empty()) what.warnings.push_back(remark);
  if (!problem.air) {
    what.warnings.emplace_back(
        "the air is not stated (--pressure, --temperature): taken as the standard atmosphere");
  }
}

// Removes false detections, which are observations of nothing.
void identify(Case& what) {
  const NamedStars named = name_stars(what.problem);
  what.warnings.insert(what.warnings.end(), named.remarks.begin(), named.remarks.end());
  for (auto i = named.false_ones.rbegin(); i != named.false_ones.rend(); ++i) {
    const auto at = static_cast<std::ptrdiff_t>(*i);
    what.problem.observations.erase(what.problem.observations.begin() + at);
    what.files.erase(what.files.begin() + at);
  }
}

std::string place_of(const Case& what, std::size_t observation) {
  return what.files[observation] + ":" +
         std::to_string(what.problem.observations[observation].line);
}

void warn_of_serials(const station::InstrumentSerials& configured,
                     const station::InstrumentSerials& calibrated, const std::string& path,
                     Case& what) {
  const std::string parts = uncompared_serials(configured, calibrated);
  if (parts.empty()) return;
  what.warnings.push_back(path + ": " + parts +
                          ": stated by the instrument or by the station alone: whether it is this "
                          "instrument was not checked");
}

void warn_of_sides(Case& what) {
  const auto unstated =
      std::ranges::count(what.problem.observations, false, &Observation::sides_stated);
  if (unstated == 0) return;
  what.warnings.push_back(std::to_string(unstated) +
                          " sightings state no approach_pan or approach_tilt: taken as 1, and off "
                          "by the backlash where the unit came from the other side");
}

}  // namespace

Instrument carried_instrument(const std::string& path, const Instrument& fallback) {
  constexpr double kArcsec = kPi / 648000.0;
  Instrument instrument = read_instrument(path, fallback);
  if (instrument.covariance_file.empty()) return instrument;
  for (const auto& [parameter, sd_arcsec] :
       {std::pair{kMountZ, 30.0}, {kMountX, 30.0}, {kMountY, 30.0}, {kTrunnion, 4.0}}) {
    instrument.covariance(parameter, parameter) += std::pow(sd_arcsec * kArcsec, 2);
  }
  return instrument;
}

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

References references_in(const std::string& path) {
  References references;
  if (path.empty()) return references;
  for (const ReferenceRow& row : read_references(path)) {
    if (row.star) {
      references[row.name] = star_of(*row.star);
    } else if (!row.utime_us) {
      references[row.name] = FixedPoint{ecef_from_geodetic(surveyed_place(row, path)), row.sd_m};
    } else {
      if (row.sd_m <= 0.0) {
        throw CsvError(path + ":" + std::to_string(row.line) +
                       ": sd_m: a position in time is not known exactly");
      }
      auto& entry = references.try_emplace(row.name, Trajectory{}).first->second;
      auto& trajectory = std::get<Trajectory>(entry);
      trajectory.points.push_back({*row.utime_us, ecef_from_geodetic(surveyed_place(row, path))});
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

Case read_stations(const CaseOptions& options) {
  if (!options.instruments.empty() && options.instruments.size() != options.stations.size()) {
    throw std::invalid_argument("--instrument: is needed for every --station, or for none");
  }
  Case what;
  what.options = options;
  for (std::size_t i = 0; i < options.stations.size(); ++i) {
    const auto settings = station::load_station_settings(options.stations[i]);
    Problem& problem = what.problem;
    if (std::ranges::find(problem.names, settings.id) != problem.names.end()) {
      throw std::invalid_argument("--station: '" + settings.id + "' is given twice");
    }
    check_plain(settings.serials, options.stations[i]);
    Instrument instrument = new_instrument(settings);
    if (options.resolution_arcsec) set_resolution(instrument, *options.resolution_arcsec);
    if (!options.instruments.empty()) {
      instrument = carried_instrument(options.instruments[i], instrument);
      check_serials(settings.serials, instrument.serials, options.instruments[i]);
      warn_of_serials(settings.serials, instrument.serials, options.instruments[i], what);
    }
    problem.names.push_back(settings.id);
    problem.stations.push_back(prior_of(settings, instrument, options.stations[i]));
    what.instruments.push_back(instrument);
  }
  return what;
}

Case read_case(const CaseOptions& options) {
  Case what = read_stations(options);
  for (const std::string& path : options.observations) {
    for (const Observation& one : read_observations(path, what.problem.names)) {
      what.problem.observations.push_back(one);
      what.files.push_back(path);
    }
  }
  warn_of_sides(what);
  what.problem.references = references_in(options.references);
  read_sky(options, what);
  identify(what);
  return what;
}

Network network_of(const Case& what) {
  try {
    return without(network_of(what.problem), what.mistaken);
  } catch (const ObservationRefused& refused) {
    throw std::runtime_error(
        place_of(what, refused.index()) + ": " + refused.what() +
        (refused.other() ? " (" + place_of(what, *refused.other()) + ")" : ""));
  }
}

void find_mistaken(Case& what, const TellAdjusted& tell) {
  what.mistaken = mistaken_sightings(network_of(what), {}, tell);
}

std::vector<std::string> mistaken_in_words(const Case& what) {
  constexpr std::size_t kMost = 20;
  std::vector<std::string> sentences;
  for (const std::size_t i : what.mistaken) {
    const Observation& one = what.problem.observations[i];
    if (sentences.size() == kMost) {
      sentences.push_back("and " + std::to_string(what.mistaken.size() - kMost) +
                          " more sightings: the report lists all");
      break;
    }
    sentences.push_back(std::string(name(one.kind)) + " '" + one.reference + "' at utime_us " +
                        std::to_string(one.utime_us) + " (" + place_of(what, i) +
                        "): this sighting is rejected as mistaken");
  }
  return sentences;
}

}  // namespace ols::calibration
