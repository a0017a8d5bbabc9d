// The estimators and the fusion, for Python.
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
  py::enum_<fusion::Solution>(m, "Solution", "Why there is no position, or OK.")
      .value("OK", fusion::Solution::kOk)
      .value("TOO_FEW_RAYS", fusion::Solution::kTooFewRays)
      .value("PARALLEL_RAYS", fusion::Solution::kParallelRays)
      .value("BEHIND_CAMERA", fusion::Solution::kBehindCamera)
      .value("TOO_FAR", fusion::Solution::kTooFar)
      .value("NOT_CONVERGED", fusion::Solution::kNotConverged)
      .value("BEARING_ONLY", fusion::Solution::kBearingOnly)
      .value("RAYS_MISS", fusion::Solution::kRaysMiss)
      .value("AMBIGUOUS", fusion::Solution::kAmbiguous);

  data_class<fusion::RayUse>(m, "RayUse", "What became of one ray.")
      .def_readwrite("used", &fusion::RayUse::used, "False: rejected as an outlier.")
      .def_readwrite("weight", &fusion::RayUse::weight, "0..1, robust weight.")
      .def_readwrite("squared", &fusion::RayUse::squared, "Squared normalised residual.")
      .def_readwrite("expected", &fusion::RayUse::expected, "Its expectation.")
      .def_readwrite("residual_rad", &fusion::RayUse::residual_rad,
                     "(2,) (cross-elevation, elevation)")
      .def_readwrite("variance_rad2", &fusion::RayUse::variance_rad2,
                     "(2,) that it was weighted by.")
      .def_readwrite("redundancy", &fusion::RayUse::redundancy,
                     "(2,) share that a residual shows.");

  data_class<fusion::Estimate>(m, "Estimate", "A located target, ECEF components; NaN for nothing.")
      .def_readwrite("solution", &fusion::Estimate::solution)
      .def_readwrite("position_ecef", &fusion::Estimate::position_ecef, "(3,) [m]")
      .def_readwrite("covariance_ecef", &fusion::Estimate::covariance_ecef, "(3, 3) [m^2]")
      .def_readwrite("covariance_white_ecef", &fusion::Estimate::covariance_white_ecef,
                     "(3, 3) [m^2]: what averaging makes smaller.")
      .def_readwrite("velocity_ecef", &fusion::Estimate::velocity_ecef, "(3,) [m/s]")
      .def_readwrite("velocity_covariance_ecef", &fusion::Estimate::velocity_covariance_ecef,
                     "(3, 3) [m^2/s^2]")
      .def_readwrite("crossing_angle_rad", &fusion::Estimate::crossing_angle_rad, "0..pi/2")
      .def_readwrite("residual", &fusion::Estimate::residual, "sqrt(chi^2 / degrees of freedom)")
      .def_readwrite("rays", &fusion::Estimate::rays, "RayUse of each ray.");
}

void bind_estimators(py::module_& m) {
  data_class<fusion::Ray>(m, "Ray", "One station's bearing at an epoch.")
      .def_readwrite("station", &fusion::Ray::station)
      .def_readwrite("sight", &fusion::Ray::sight, "LineOfSight; a copy, replaced as a whole.")
      .def_readwrite("rate_rad_s", &fusion::Ray::rate_rad_s, "(2,) (cross-elevation, elevation)")
      .def_readwrite("rate_covariance", &fusion::Ray::rate_covariance, "(2, 2) [rad^2/s^2]")
      .def_readwrite("clock_sd_s", &fusion::Ray::clock_sd_s)
      .def_readwrite("belief", &fusion::Ray::belief)
      .def_readwrite("age_s", &fusion::Ray::age_s);

  m.def(
      "least_squares",
      [](const std::vector<fusion::Ray>& rays) { return fusion::least_squares(rays); }, arg("rays"),
      "Joint maximum-likelihood Estimate from Rays, robust to a bad one.");

  data_class<fusion::PaperView>(m, "PaperView", "A camera centre, a direction (ECEF) and a belief.")
      .def_readwrite("centre_ecef", &fusion::PaperView::centre_ecef, "(3,) [m]")
      .def_readwrite("direction_ecef", &fusion::PaperView::direction_ecef, "(3,) unit vector")
      .def_readwrite("belief", &fusion::PaperView::belief);
  const auto answer = [](const fusion::PaperPoint& point) {
    return py::make_tuple(point.solution, point.position_ecef);
  };
  m.def(
      "paper_two_view",
      [answer](const fusion::PaperView& first, const fusion::PaperView& second) {
        return answer(fusion::paper_two_view(first, second));
      },
      arg("first"), arg("second"),
      "(Solution, (3,) ECEF position): the paper's mid-plane intersection, section 6.");
  m.def(
      "paper_n_view",
      [answer](const std::vector<fusion::PaperView>& views) {
        return answer(fusion::paper_n_view(views));
      },
      arg("views"), "(Solution, (3,) ECEF position): the paper's Algorithm 1.");
  m.def(
      "paper_best_baseline",
      [answer](const std::vector<fusion::PaperView>& views) {
        return answer(fusion::paper_n_view(views, {.pairs = fusion::PaperPairs::kBestBaseline}));
      },
      arg("views"), "(Solution, (3,) ECEF position): the paper's best baseline, section 4.1.");
}

void bind_configs(py::module_& m) {
  data_class<fusion::AlignmentConfig>(m, "AlignmentConfig", "Bringing bearings to an epoch.")
      .def_readwrite("window_s", &fusion::AlignmentConfig::window_s)
      .def_readwrite("max_age_s", &fusion::AlignmentConfig::max_age_s)
      .def_readwrite("rate_sd_rad_s", &fusion::AlignmentConfig::rate_sd_rad_s)
      .def_readwrite("acceleration_sd_m_s2", &fusion::AlignmentConfig::acceleration_sd_m_s2)
      .def_readwrite("range_unknown_m", &fusion::AlignmentConfig::range_unknown_m);

  data_class<fusion::LeastSquaresConfig>(m, "LeastSquaresConfig",
                                         "The least-squares estimator of one epoch.")
      .def_readwrite("gate_sigma", &fusion::LeastSquaresConfig::gate_sigma)
      .def_readwrite("huber_sigma", &fusion::LeastSquaresConfig::huber_sigma)
      .def_readwrite("range_sd_limit", &fusion::LeastSquaresConfig::range_sd_limit)
      .def_readwrite("max_range_m", &fusion::LeastSquaresConfig::max_range_m)
      .def_readwrite("max_iterations", &fusion::LeastSquaresConfig::max_iterations);

  py::enum_<fusion::PaperPairs>(m, "PaperPairs", "What becomes of the pairs of stations.")
      .value("ALGORITHM_1", fusion::PaperPairs::kAlgorithm1)
      .value("CENTROID", fusion::PaperPairs::kCentroid)
      .value("BEST_BASELINE", fusion::PaperPairs::kBestBaseline);

  data_class<fusion::PaperConfig>(m, "PaperConfig", "The parts of the paper's estimator.")
      .def_readwrite("pairs", &fusion::PaperConfig::pairs)
      .def_readwrite("by_belief", &fusion::PaperConfig::by_belief)
      .def_readwrite("moving_average", &fusion::PaperConfig::moving_average);

  data_class<fusion::EstimatorConfig>(m, "EstimatorConfig", "Of the estimators without memory.")
      .def_readwrite("alignment", &fusion::EstimatorConfig::alignment)
      .def_readwrite("least_squares", &fusion::EstimatorConfig::least_squares)
      .def_readwrite("paper", &fusion::EstimatorConfig::paper);

  data_class<fusion::FusionConfig>(m, "FusionConfig",
                                   "The fusion; nested ones are replaced as a whole.")
      .def_property(
          "min_belief", [](const fusion::FusionConfig& c) { return c.admission.min_belief; },
          [](fusion::FusionConfig& c, double belief) { c.admission.min_belief = belief; })
      .def_readwrite("estimators", &fusion::FusionConfig::estimators);
}

void bind_fusion(py::module_& m) {
  data_class<fusion::BearingMeasurement>(m, "BearingMeasurement", "One bearing of one station.")
      .def_readwrite("station", &fusion::BearingMeasurement::station)
      .def_readwrite("utime_us", &fusion::BearingMeasurement::utime_us,
                     "UTC since 1970 [us] at mid-exposure.")
      .def_readwrite("sight", &fusion::BearingMeasurement::sight,
                     "LineOfSight; a copy, replaced as a whole.")
      .def_readwrite("belief", &fusion::BearingMeasurement::belief)
      .def_readwrite("clock_sd_s", &fusion::BearingMeasurement::clock_sd_s)
      .def_readwrite("track_id", &fusion::BearingMeasurement::track_id);

  m.def(
      "align",
      [](const std::vector<fusion::BearingMeasurement>& sightings, std::int64_t epoch_us,
         std::optional<double> range_m) { return align(sightings, epoch_us, range_m); },
      arg("sightings"), arg("epoch_us"), arg("range_m") = std::nullopt,
      "One station's Sightings, in order of time -> its Ray at the epoch, or None.");

  data_class<fusion::ContributingStation>(m, "ContributingStation",
                                          "What became of a station's bearings.")
      .def_readwrite("station", &fusion::ContributingStation::station)
      .def_readwrite("used", &fusion::ContributingStation::used)
      .def_readwrite("weight", &fusion::ContributingStation::weight)
      .def_readwrite("age_s", &fusion::ContributingStation::age_s);

  data_class<fusion::FusedTarget>(m, "FusedTarget", "A located target at an epoch.")
      .def_readwrite("utime_us", &fusion::FusedTarget::utime_us)
      .def_readwrite("target_id", &fusion::FusedTarget::target_id)
      .def_readwrite("estimator", &fusion::FusedTarget::estimator)
      .def_readwrite("estimate", &fusion::FusedTarget::estimate)
      .def_readwrite("contributing", &fusion::FusedTarget::stations,
                     "ContributingStations, in the order of estimate.rays.")
      .def_property_readonly(
          "stations",
          [](const fusion::FusedTarget& target) {
            std::vector<std::string> names;
            for (const auto& station : target.stations) names.push_back(station.station);
            return names;
          },
          "Names, in the order of estimate.rays.");

  data_class<fusion::OfflineConfig>(m, "OfflineConfig",
                                    "What fuse_offline does; see --help of ols-fuse.")
      .def_readwrite("estimator", &fusion::OfflineConfig::estimator,
                     "filter, least-squares or paper")
      .def_readwrite("smooth", &fusion::OfflineConfig::smooth, "The filter's alone.")
      .def_readwrite("rate_hz", &fusion::OfflineConfig::rate_hz,
                     "Epochs on an even grid; 0: at the instant of every bearing.")
      .def_readwrite("fusion", &fusion::OfflineConfig::fusion,
                     "FusionConfig, replaced as a whole.");

  m.def(
      "fuse_offline",
      [](const std::vector<fusion::BearingMeasurement>& sightings,
         const fusion::OfflineConfig& config) { return fusion::fuse_offline(sightings, config); },
      arg("sightings"), arg("config") = fusion::OfflineConfig{},
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
