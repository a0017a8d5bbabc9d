#include <pybind11/stl.h>

#include "central/estimators/alignment.h"
#include "central/estimators/least_squares.h"
#include "central/estimators/paper_triangulation.h"
#include "central/offline/offline_fusion.h"
#include "tools/python/bindings.h"
#include "tools/python/eigen_caster.h"

namespace ols::python {
namespace {

using py::arg;

void bind_results(py::module_& m) {
  py::enum_<Solution>(m, "Solution", "Why there is no position, or OK.")
      .value("OK", Solution::kOk)
      .value("TOO_FEW_RAYS", Solution::kTooFewRays)
      .value("PARALLEL_RAYS", Solution::kParallelRays)
      .value("BEHIND_CAMERA", Solution::kBehindCamera)
      .value("TOO_FAR", Solution::kTooFar)
      .value("NOT_CONVERGED", Solution::kNotConverged)
      .value("BEARING_ONLY", Solution::kBearingOnly)
      .value("RAYS_MISS", Solution::kRaysMiss);

  data_class<RayUse>(m, "RayUse", "What became of one ray.")
      .def_readwrite("used", &RayUse::used, "False: set aside as an outlier.")
      .def_readwrite("weight", &RayUse::weight, "0..1, robust weight.")
      .def_readwrite("squared", &RayUse::squared, "Squared normalised residual.")
      .def_readwrite("expected", &RayUse::expected, "Its expectation.")
      .def_readwrite("residual_rad", &RayUse::residual_rad, "(2,) (cross-elevation, elevation)")
      .def_readwrite("variance_rad2", &RayUse::variance_rad2, "(2,) that it was weighted by.")
      .def_readwrite("redundancy", &RayUse::redundancy, "(2,) share that a residual shows.");

  data_class<Estimate>(m, "Estimate", "A located target, ECEF components; NaN for nothing.")
      .def_readwrite("solution", &Estimate::solution)
      .def_readwrite("position_ecef", &Estimate::position_ecef, "(3,) [m]")
      .def_readwrite("covariance_ecef", &Estimate::covariance_ecef, "(3, 3) [m^2]")
      .def_readwrite("covariance_white_ecef", &Estimate::covariance_white_ecef,
                     "(3, 3) [m^2]: what averaging makes smaller.")
      .def_readwrite("velocity_ecef", &Estimate::velocity_ecef, "(3,) [m/s]")
      .def_readwrite("velocity_covariance_ecef", &Estimate::velocity_covariance_ecef,
                     "(3, 3) [m^2/s^2]")
      .def_readwrite("crossing_angle_rad", &Estimate::crossing_angle_rad, "0..pi/2")
      .def_readwrite("residual", &Estimate::residual, "sqrt(chi^2 / degrees of freedom)")
      .def_readwrite("rays", &Estimate::rays, "RayUse of each ray.");
}

void bind_estimators(py::module_& m) {
  data_class<Ray>(m, "Ray", "One station's bearing at an epoch.")
      .def_readwrite("station", &Ray::station)
      .def_readwrite("sight", &Ray::sight, "LineOfSight; a copy, replaced as a whole.")
      .def_readwrite("rate_rad_s", &Ray::rate_rad_s, "(2,) (cross-elevation, elevation)")
      .def_readwrite("rate_covariance", &Ray::rate_covariance, "(2, 2) [rad^2/s^2]")
      .def_readwrite("clock_sd_s", &Ray::clock_sd_s)
      .def_readwrite("belief", &Ray::belief)
      .def_readwrite("age_s", &Ray::age_s);

  m.def(
      "least_squares", [](const std::vector<Ray>& rays) { return least_squares(rays); },
      arg("rays"), "Joint maximum-likelihood Estimate from Rays, robust to a bad one.");

  data_class<PaperView>(m, "PaperView", "A camera centre, a direction (ECEF) and a belief.")
      .def_readwrite("centre_ecef", &PaperView::centre_ecef, "(3,) [m]")
      .def_readwrite("direction_ecef", &PaperView::direction_ecef, "(3,) unit vector")
      .def_readwrite("belief", &PaperView::belief);
  const auto answer = [](const PaperPoint& point) {
    return py::make_tuple(point.solution, point.position_ecef);
  };
  m.def(
      "paper_two_view",
      [answer](const PaperView& first, const PaperView& second) {
        return answer(paper_two_view(first, second));
      },
      arg("first"), arg("second"),
      "(Solution, (3,) ECEF position): the paper's mid-plane intersection, section 6.");
  m.def(
      "paper_n_view",
      [answer](const std::vector<PaperView>& views) { return answer(paper_n_view(views)); },
      arg("views"), "(Solution, (3,) ECEF position): the paper's Algorithm 1.");
  m.def(
      "paper_best_baseline",
      [answer](const std::vector<PaperView>& views) {
        return answer(paper_n_view(views, {.pairs = PaperPairs::kBestBaseline}));
      },
      arg("views"), "(Solution, (3,) ECEF position): the paper's best baseline, section 4.1.");
}

void bind_configs(py::module_& m) {
  data_class<AlignmentConfig>(m, "AlignmentConfig", "Bringing bearings to an epoch.")
      .def_readwrite("window_s", &AlignmentConfig::window_s)
      .def_readwrite("max_age_s", &AlignmentConfig::max_age_s)
      .def_readwrite("rate_sd_rad_s", &AlignmentConfig::rate_sd_rad_s)
      .def_readwrite("acceleration_sd_m_s2", &AlignmentConfig::acceleration_sd_m_s2)
      .def_readwrite("range_unknown_m", &AlignmentConfig::range_unknown_m);

  data_class<LeastSquaresConfig>(m, "LeastSquaresConfig",
                                 "The least-squares estimator of one epoch.")
      .def_readwrite("gate_sigma", &LeastSquaresConfig::gate_sigma)
      .def_readwrite("huber_sigma", &LeastSquaresConfig::huber_sigma)
      .def_readwrite("range_sd_limit", &LeastSquaresConfig::range_sd_limit)
      .def_readwrite("max_range_m", &LeastSquaresConfig::max_range_m)
      .def_readwrite("max_iterations", &LeastSquaresConfig::max_iterations);

  py::enum_<PaperPairs>(m, "PaperPairs", "What becomes of the pairs of stations.")
      .value("ALGORITHM_1", PaperPairs::kAlgorithm1)
      .value("CENTROID", PaperPairs::kCentroid)
      .value("BEST_BASELINE", PaperPairs::kBestBaseline);

  data_class<PaperConfig>(m, "PaperConfig", "The parts of the paper's estimator.")
      .def_readwrite("pairs", &PaperConfig::pairs)
      .def_readwrite("by_belief", &PaperConfig::by_belief)
      .def_readwrite("moving_average", &PaperConfig::moving_average);

  data_class<EstimatorConfig>(m, "EstimatorConfig", "Of the estimators without memory.")
      .def_readwrite("alignment", &EstimatorConfig::alignment)
      .def_readwrite("least_squares", &EstimatorConfig::least_squares)
      .def_readwrite("paper", &EstimatorConfig::paper);

  data_class<FusionConfig>(m, "FusionConfig", "The fusion; nested ones are replaced as a whole.")
      .def_property(
          "min_belief", [](const FusionConfig& c) { return c.admission.min_belief; },
          [](FusionConfig& c, double belief) { c.admission.min_belief = belief; })
      .def_readwrite("estimators", &FusionConfig::estimators);
}

void bind_fusion(py::module_& m) {
  data_class<BearingMeasurement>(m, "BearingMeasurement", "One bearing of one station.")
      .def_readwrite("station", &BearingMeasurement::station)
      .def_readwrite("utime_us", &BearingMeasurement::utime_us, "UTC since 1970 [us] at mid-exposure.")
      .def_readwrite("sight", &BearingMeasurement::sight, "LineOfSight; a copy, replaced as a whole.")
      .def_readwrite("belief", &BearingMeasurement::belief)
      .def_readwrite("clock_sd_s", &BearingMeasurement::clock_sd_s)
      .def_readwrite("track_id", &BearingMeasurement::track_id);

  m.def(
      "align",
      [](const std::vector<BearingMeasurement>& sightings, std::int64_t epoch_us,
         std::optional<double> range_m) { return align(sightings, epoch_us, range_m); },
      arg("sightings"), arg("epoch_us"), arg("range_m") = std::nullopt,
      "One station's Sightings, in order of time -> its Ray at the epoch, or None.");

  data_class<ContributingStation>(m, "ContributingStation", "What became of a station's bearings.")
      .def_readwrite("station", &ContributingStation::station)
      .def_readwrite("used", &ContributingStation::used)
      .def_readwrite("weight", &ContributingStation::weight)
      .def_readwrite("age_s", &ContributingStation::age_s);

  data_class<FusedTarget>(m, "FusedTarget", "A located target at an epoch.")
      .def_readwrite("utime_us", &FusedTarget::utime_us)
      .def_readwrite("target_id", &FusedTarget::target_id)
      .def_readwrite("estimator", &FusedTarget::estimator)
      .def_readwrite("estimate", &FusedTarget::estimate)
      .def_readwrite("contributing", &FusedTarget::stations,
                     "ContributingStations, in the order of estimate.rays.")
      .def_property_readonly(
          "stations",
          [](const FusedTarget& target) {
            std::vector<std::string> names;
            for (const auto& station : target.stations) names.push_back(station.station);
            return names;
          },
          "Names, in the order of estimate.rays.");

  data_class<OfflineConfig>(m, "OfflineConfig", "What fuse_offline does; see --help of ols-fuse.")
      .def_readwrite("estimator", &OfflineConfig::estimator, "filter, least-squares or paper")
      .def_readwrite("smooth", &OfflineConfig::smooth, "The filter's alone.")
      .def_readwrite("rate_hz", &OfflineConfig::rate_hz,
                     "Epochs on an even grid; 0: at the instant of every bearing.")
      .def_readwrite("fusion", &OfflineConfig::fusion, "FusionConfig, replaced as a whole.");

  m.def(
      "fuse_offline",
      [](const std::vector<BearingMeasurement>& sightings, const OfflineConfig& config) {
        return fuse_offline(sightings, config);
      },
      arg("sightings"), arg("config") = OfflineConfig{},
      "One target's Sightings -> FusedTargets with a position; as the program ols-fuse.");
}

}  // namespace

void bind_central(py::module_& m) {
  bind_results(m);
  bind_estimators(m);
  bind_configs(m);
  bind_fusion(m);
}

}  // namespace ols::python
