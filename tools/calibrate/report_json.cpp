// report.json: everything that the tests found, for other programs.
#include <cmath>
#include <nlohmann/json.hpp>

#include "calibration/rectification.h"
#include "calibration/systematic.h"
#include "geometry/angles.h"
#include "tools/calibrate/result_files.h"

namespace ols::calibration {
namespace {

using Json = nlohmann::ordered_json;

double arcsec(double rad) { return 3600.0 * degrees(rad); }

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json parameters_of(const StationResult& result) {
  Json all = Json::array();
  StationVector values;
  values << instrument_of(result.state.model), result.state.model.geometry.chain.heading_rad,
      result.state.model.geometry.chain.tilt_x_rad, result.state.model.geometry.chain.tilt_y_rad,
      result.state.change.segment<3>(kEast), result.state.refraction, result.state.air;
  for (int i = 0; i < kStationParameters; ++i) {
    all.push_back({{"parameter", parameter_texts()[static_cast<std::size_t>(i)].key},
                   {"value", to_file(i, values[i])},
                   {"sd", to_file(i, std::sqrt(result.covariance(i, i)))},
                   {"prior_sd", to_file(i, std::sqrt(result.prior_covariance(i, i)))}});
  }
  return all;
}

using AzimuthRow = Eigen::Matrix<double, 1, kStationParameters>;

// Derivative of the mean azimuth of the horizon, all around, by the parameters. The heading's
// deviation alone says little, because its error is shared with the mounting.
AzimuthRow mean_azimuth(const StationModel& model) {
  constexpr int kPans = 12;
  constexpr double kTurn = 5.0 / 6.0;  // pan -150..150 degrees
  AzimuthRow J = AzimuthRow::Zero();
  for (int i = 0; i < kPans; ++i) {
    UnitReading reading;
    reading.pan.counts =
        static_cast<double>(model.pan.counts_per_turn) * ((i + 0.5) / kPans - 0.5) * kTurn;
    reading.pan.approach = reading.tilt.approach = i % 2 == 0 ? 1 : -1;
    const auto seen = predict_direction(model, reading,
                                        {model.geometry.camera.cx_px, model.geometry.camera.cy_px});
    if (seen) J.head<kModelParameters>() += seen->by_parameters.row(0) / kPans;
  }
  return J;
}

Json acceptance_of(const Acceptance& acceptance) {
  Json findings = Json::array();
  for (const Finding& one : acceptance.findings) {
    findings.push_back({{"name", one.name},
                        {"judgement", to_string(one.judgement)},
                        {"value", finite(one.value)},
                        {"limit", one.limit},
                        {"sentence", one.sentence}});
  }
  return {{"acceptable", acceptance.acceptable()},
          {"findings", findings},
          {"working_volume",
           {{"pan_deg", acceptance.volume.pan_deg},
            {"lowest_deg", acceptance.volume.lowest_deg},
            {"highest_deg", acceptance.volume.highest_deg},
            {"is_cut", acceptance.volume_is_cut}}}};
}

// Without a heading a direction is not known at all.
Json stations_of(const std::vector<StationResult>& results, bool headings_known) {
  const auto known = [headings_known](double rad) {
    return headings_known ? Json(arcsec(rad)) : Json(nullptr);
  };
  Json all = Json::array();
  for (const StationResult& result : results) {
    const VolumePrecision volume = volume_precision(result.state.model, result.covariance);
    const AzimuthRow azimuth = mean_azimuth(result.state.model);
    all.push_back({{"station", result.id},
                   {"calibration_id", result.calibration_id},
                   {"systematic_rms_arcsec", known(volume.rms_rad)},
                   {"systematic_worst_arcsec", known(volume.worst_rad)},
                   {"mean_azimuth_sd_arcsec",
                    known(std::sqrt((azimuth * result.covariance * azimuth.transpose())(0, 0)))},
                   {"acceptance", acceptance_of(result.acceptance)},
                   {"parameters", parameters_of(result)}});
  }
  return all;
}

Json groups_of(const Adjustment& adjustment, const Calibration& found) {
  Json all = Json::array();
  for (std::size_t g = 0; g < found.tests.size(); ++g) {
    const Group& group = adjustment.groups()[g];
    const GroupTest& test = found.tests[g];
    Json one{{"kind", name(group.kind)},
             {"name", group.name},
             {"station", adjustment.network().names[group.station]},
             {"sightings", group.observations.size()}};
    if (group.is_tested()) {
      one["rejected"] = test.rejected;
      one["w"] = finite(test.w);
      one["critical"] = test.critical;
      one["detectable_across_arcsec"] = finite(arcsec(test.detectable_rad[0]));
      one["detectable_up_arcsec"] = finite(arcsec(test.detectable_rad[1]));
    }
    all.push_back(std::move(one));
  }
  return all;
}

// Indexed by observation.
std::vector<bool> rejected_observations(const Adjustment& adjustment, const Calibration& found) {
  std::vector<bool> rejected(found.residuals.size(), false);
  for (std::size_t g = 0; g < found.tests.size(); ++g) {
    if (!found.tests[g].rejected) continue;
    for (const std::size_t i : adjustment.groups()[g].observations) rejected[i] = true;
  }
  return rejected;
}

Json residuals_of(const Case& what, const Adjustment& adjustment, const Calibration& found) {
  Json all = Json::array();
  const std::vector<bool> rejected = rejected_observations(adjustment, found);
  for (std::size_t i = 0; i < found.residuals.size(); ++i) {
    if (!found.residuals[i]) continue;
    const Observation& one = what.problem.observations[i];
    const bool level = one.kind == Kind::kInclinometer;
    const double unit = level ? degrees(1.0) : 1.0;
    all.push_back({{"line", one.line},
                   {"kind", name(one.kind)},
                   {"reference", one.reference},
                   {"rejected", bool{rejected[i]}},
                   {level ? "x_deg" : "x_px", unit * found.residuals[i]->x()},
                   {level ? "y_deg" : "y_px", unit * found.residuals[i]->y()}});
  }
  return all;
}

Json mistaken_of(const Case& what) {
  Json all = Json::array();
  for (const std::size_t i : what.mistaken) {
    const Observation& one = what.problem.observations[i];
    all.push_back({{"file", what.files[i]},
                   {"line", one.line},
                   {"kind", name(one.kind)},
                   {"reference", one.reference},
                   {"station", what.problem.names[one.station]},
                   {"utime_us", one.utime_us}});
  }
  return all;
}

Json rectification_of(const Case& what, const Adjustment& adjustment, const Calibration& found) {
  Json all = Json::array();
  for (std::size_t s = 0; s < adjustment.network().stations.size(); ++s) {
    for (const RectifiedAngle& one : rectified_angles(what.problem, adjustment, found, s)) {
      all.push_back({{"station", adjustment.network().names[s]},
                     {"angle", to_string(one.kind)},
                     {"value_deg", degrees(one.rad)},
                     {"sd_arcsec", arcsec(one.sd_rad)}});
    }
  }
  return all;
}

Json differences_of(const Adjustment& adjustment, const Calibration& found) {
  Json all = Json::array();
  const Network& network = adjustment.network();
  for (std::size_t a = 0; a < network.stations.size(); ++a) {
    for (std::size_t b = a + 1; b < network.stations.size(); ++b) {
      Eigen::RowVectorXd J = Eigen::RowVectorXd::Zero(network.layout.size());
      const auto& stations = found.fit.state.stations;
      J.segment<kStationParameters>(network.layout.station(a)) = mean_azimuth(stations[a].model);
      J.segment<kStationParameters>(network.layout.station(b)) = -mean_azimuth(stations[b].model);
      const double variance = (J * found.fit.covariance * J.transpose())(0, 0);
      all.push_back({{"stations", {network.names[a], network.names[b]}},
                     {"sd_arcsec", arcsec(found.scaled_by * std::sqrt(variance))}});
    }
  }
  return all;
}

}  // namespace

std::string report_json(const Case& what, const Adjustment& adjustment, const Calibration& found,
                        const std::vector<StationResult>& results) {
  Json remarks = found.remarks;
  for (const std::string& warning : what.warnings) remarks.push_back(warning);
  const Json report{{"stations", stations_of(results, found.headings_known)},
                    {"remarks", remarks},
                    {"variance_factor", found.global.variance_factor},
                    {"variance_factor_critical", found.global.critical},
                    {"redundancy", found.global.redundancy},
                    {"deviations_scaled_by", found.scaled_by},
                    {"rectification", rectification_of(what, adjustment, found)},
                    {"heading_differences", differences_of(adjustment, found)},
                    {"groups", groups_of(adjustment, found)},
                    {"rejected_sightings", mistaken_of(what)},
                    {"residuals", residuals_of(what, adjustment, found)}};
  return report.dump(1) + "\n";
}

}  // namespace ols::calibration
