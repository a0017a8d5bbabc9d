#include "tools/calibrate/result_files.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "calibration/systematic.h"
#include "edge/calibration/calibration_folder.h"
#include "geometry/angles.h"
#include "tools/calibrate/calibration_csv.h"

namespace ols::calibration {
namespace {

std::string covariance_text(const StationMatrix& covariance) {
  std::ostringstream out;
  out << std::setprecision(12) << "parameter";
  for (const ParameterText& text : parameter_texts()) out << ',' << text.key;
  out << '\n';
  for (int i = 0; i < kStationParameters; ++i) {
    out << parameter_texts()[static_cast<std::size_t>(i)].key;
    for (int j = 0; j < kStationParameters; ++j) {
      out << ',' << to_file(i, to_file(j, covariance(i, j)));
    }
    out << '\n';
  }
  return out.str();
}

// UTC of the last observation; 0 where none has a time.
std::int64_t observed_utime_us(const Case& what, std::size_t station) {
  std::int64_t last_us = 0;
  for (const Observation& one : what.problem.observations) {
    if (one.station == station) last_us = std::max(last_us, one.utime_us);
  }
  return last_us;
}

std::string setup_text(const std::string& id, std::int64_t utime_us, const StationState& state) {
  const StationGeometry& geometry = state.model.geometry;
  std::ostringstream out;
  out << std::fixed << std::setprecision(9)
      << "\n[pose]\nlatitude_deg = " << degrees(geometry.position.latitude_rad)
      << "\nlongitude_deg = " << degrees(geometry.position.longitude_rad) << std::setprecision(4)
      << "\nheight_m = " << geometry.position.height_m << std::setprecision(8)
      << "\nheading_deg = " << degrees(wrap_two_pi(geometry.chain.heading_rad))
      << "\ntilt_x_deg = " << degrees(geometry.chain.tilt_x_rad)
      << "\ntilt_y_deg = " << degrees(geometry.chain.tilt_y_rad)
      << "\n\n[air]\nrefraction_k = " << state.refraction << "\nair = " << state.air << "\n";
  const std::string observed =
      utime_us > 0 ? "observed_utime_us = " + std::to_string(utime_us) + "\n" : "";
  return "station = \"" + id + "\"\n" + observed + out.str();
}

const StationResult& result_of(const std::vector<StationResult>& results, const PredictRow& row,
                               const std::string& path) {
  const auto fail = [&](const std::string& why) {
    throw CsvError(path + ":" + std::to_string(row.line) + ": station: " + why);
  };
  if (row.station.empty()) {
    if (results.size() > 1) fail("is missing: there are several");
    return results.front();
  }
  const auto found = std::ranges::find(results, row.station, &StationResult::id);
  if (found == results.end()) fail("'" + row.station + "' is not one of the stations");
  return *found;
}

}  // namespace

std::vector<StationResult> station_results(const Case& what, const Adjustment& adjustment,
                                           const Calibration& found) {
  const Network& network = adjustment.network();
  std::vector<StationResult> results;
  for (std::size_t i = 0; i < network.stations.size(); ++i) {
    StationResult result;
    result.id = network.names[i];
    result.state = found.fit.state.stations[i];
    result.prior_covariance = network.stations[i].covariance;
    result.covariance = found.covariance(network, i);
    result.acceptance = found.headings_known ? judge_calibration(what.problem, adjustment, found, i)
                                             : judge_instrument(what.problem, adjustment, found, i);
    Instrument instrument = what.instruments[i];
    instrument.values = instrument_of(result.state.model);
    instrument.covariance =
        result.covariance.topLeftCorner<kInstrumentParameters, kInstrumentParameters>();
    instrument.covariance_file = "covariance.csv";
    result.instrument = instrument_text(instrument);
    result.covariance_csv = covariance_text(result.covariance);
    const std::string setup = setup_text(result.id, observed_utime_us(what, i), result.state);
    result.calibration_id =
        station::calibration_id_of(result.instrument, setup, result.covariance_csv);
    result.setup =
        "# A setup of a station (docs/calibration.md); the instrument is beside it.\n"
        "calibration_id = " +
        std::to_string(result.calibration_id) + "\n" + setup;
    results.push_back(std::move(result));
  }
  return results;
}

std::string predictions(const Case& what, const std::vector<StationResult>& results) {
  const std::string& path = what.options.predict;
  std::ostringstream out;
  out << std::fixed;
  if (results.size() > 1) out << "station,";
  out << "pan_counts,tilt_counts,approach_pan,approach_tilt,x_px,y_px,utime_us,azimuth_deg,"
         "elevation_deg,cross_cross_deg2,cross_elevation_deg2,elevation_elevation_deg2\n";
  for (const PredictRow& row : read_predictions(path)) {
    const StationResult& result = result_of(results, row, path);
    const UnitReading reading{{row.pan_counts, 0.0, row.approach_pan},
                              {row.tilt_counts, 0.0, row.approach_tilt}};
    const auto seen =
        systematic_direction(result.state.model, result.covariance, reading, {row.x_px, row.y_px});
    if (!seen) {
      throw CsvError(path + ":" + std::to_string(row.line) +
                     ": x_px: is outside of the lens model");
    }
    const Eigen::Matrix2d deg2 = std::pow(degrees(1.0), 2) * seen->covariance_rad2;
    if (results.size() > 1) out << result.id << ',';
    out << std::setprecision(3) << row.pan_counts << ',' << row.tilt_counts << ','
        << row.approach_pan << ',' << row.approach_tilt << ',' << row.x_px << ',' << row.y_px << ','
        << row.utime_us << std::setprecision(9) << ',' << degrees(seen->direction.azimuth_rad)
        << ',' << degrees(seen->direction.elevation_rad) << std::scientific << ',' << deg2(0, 0)
        << ',' << deg2(0, 1) << ',' << deg2(1, 1) << std::fixed << '\n';
  }
  return out.str();
}

std::vector<OutputFile> output_files(const Case& what, const Adjustment& adjustment,
                                     const Calibration& found) {
  if (!found.headings_known && !what.options.predict.empty()) {
    throw std::invalid_argument("--predict: the observations do not determine a heading");
  }
  const auto results = station_results(what, adjustment, found);
  std::vector<OutputFile> files;
  for (const StationResult& result : results) {
    const std::string folder = results.size() == 1 ? "" : result.id + "/";
    files.push_back({folder + "instrument.toml", result.instrument});
    if (found.headings_known) files.push_back({folder + "setup.toml", result.setup});
    files.push_back({folder + "covariance.csv", result.covariance_csv});
  }
  if (!what.options.predict.empty()) {
    files.push_back({"predictions.csv", predictions(what, results)});
  }
  files.push_back({"report.json", report_json(what, adjustment, found, results)});
  files.push_back({"report.html", report_html(what, adjustment, found, results)});
  return files;
}

}  // namespace ols::calibration
