// The precision theory and the UTM grid, for Python.
#include <pybind11/stl.h>

#include <map>

#include "geometry/placement.h"
#include "geometry/precision.h"
#include "geometry/precision_paper.h"
#include "geometry/utm.h"
#include "tools/python/bindings.h"
#include "tools/python/eigen_caster.h"

namespace ols::python {
namespace {

using py::arg;

void bind_utm(py::module_& m) {
  data_class<Utm>(m, "Utm", "A place in the Universal Transverse Mercator grid.")
      .def_readwrite("zone", &Utm::zone, "1..60")
      .def_readwrite("northern", &Utm::northern)
      .def_readwrite("easting_m", &Utm::easting_m)
      .def_readwrite("northing_m", &Utm::northing_m);
  data_class<UtmPoint>(m, "UtmPoint", "A place in the grid, and the grid there.")
      .def_readwrite("position", &UtmPoint::position)
      .def_readwrite("convergence_rad", &UtmPoint::convergence_rad,
                     "Of grid north, clockwise from true north.")
      .def_readwrite("scale", &UtmPoint::scale, "Grid distance over true distance.");
  m.def("geodetic_from_utm", &geodetic_from_utm, arg("position"), arg("height_m"),
        "Utm, ellipsoidal height [m] -> Geodetic; ValueError outside the zone.");
  m.def("utm_from_geodetic", &utm_from_geodetic, arg("position"),
        "Geodetic -> UtmPoint in its standard zone; ValueError near the poles.");
}

void bind_paper_precision(py::module_& m) {
  data_class<PixelError>(m, "PixelError", "An error of so many pixels (the paper's p, r, f).")
      .def_readwrite("pixels", &PixelError::pixels)
      .def_readwrite("pixel_m", &PixelError::pixel_m)
      .def_readwrite("focal_length_m", &PixelError::focal_length_m)
      .def("tangent", &PixelError::tangent, "p r / f");
  m.def("canonical_stereo_error_m", &canonical_stereo_error_m, arg("error"), arg("base_m"),
        arg("depth_m"), "The paper's E = p r Z^2 / (f b - p r Z) [m].");
  m.def("rotating_pair_error_m", &rotating_pair_error_m, arg("error"), arg("base_m"),
        arg("distance_m"), "The paper's E = B tan(arctan(D / B) + arctan(p r / f)) - D [m].");
  m.def("pair_error_m", &pair_error_m, arg("first"), arg("second"), arg("target"), arg("angle_rad"),
        "Greatest error [m] of two (3,) cameras that are off by up to an angle.");
  m.def("table_target", &table_target, arg("base_m"), arg("distance_m"), arg("alpha_rad"),
        arg("side"), "(3,) target of a row of Table 1; see geometry/precision_paper.h.");
  data_class<Baseline>(m, "Baseline", "A pair of cameras.")
      .def_readwrite("first", &Baseline::first, "(3,) [m]")
      .def_readwrite("second", &Baseline::second, "(3,) [m]");
  m.def("normal_component", &normal_component, arg("baseline"), arg("target"),
        "The paper's t . n, 0..1.");
  m.def(
      "best_baseline",
      [](const std::vector<Baseline>& baselines, const Eigen::Vector3d& target) {
        return best_baseline(baselines, target);
      },
      arg("baselines"), arg("target"), "The paper's argmax t . n: an index.");
}

void bind_bound(py::module_& m) {
  py::enum_<ErrorSource>(m, "ErrorSource", "Where an error comes from.")
      .value("WHITE", ErrorSource::kWhite)
      .value("HEADING", ErrorSource::kHeading)
      .value("TILT", ErrorSource::kTilt)
      .value("MOUNTING", ErrorSource::kMounting)
      .value("POSITION", ErrorSource::kPosition)
      .value("CLOCK", ErrorSource::kClock);
  data_class<PlannedStation>(m, "PlannedStation", "A station as a plan knows it.")
      .def_readwrite("place", &PlannedStation::place, "LocalFrame at the camera centre.")
      .def_readwrite("white_rad", &PlannedStation::white_rad, "New with every frame, each axis.")
      .def_readwrite("calibration", &PlannedStation::calibration, "CalibrationSd; stays.")
      .def_readwrite("clock_sd_s", &PlannedStation::clock_sd_s, "Stays.");
  data_class<PlannedTarget>(m, "PlannedTarget", "A target as a plan knows it.")
      .def_readwrite("p_ecef", &PlannedTarget::p_ecef, "(3,) [m]")
      .def_readwrite("velocity_moment_ecef", &PlannedTarget::velocity_moment_ecef,
                     "(3, 3) E[v v'] [m^2/s^2]");
  data_class<PositionPrecision>(m, "PositionPrecision", "The Cramer-Rao bound and its parts.")
      .def_readwrite("covariance_ecef", &PositionPrecision::covariance_ecef, "(3, 3) [m^2]")
      .def_property(
          "parts_ecef",
          [](const PositionPrecision& precision) {
            py::dict parts;
            for (std::size_t i = 0; i < kErrorSources.size(); ++i) {
              parts[py::cast(kErrorSources.at(i))] = precision.parts_ecef.at(i);
            }
            return parts;
          },
          [](PositionPrecision& precision, const std::map<ErrorSource, Eigen::Matrix3d>& parts) {
            for (std::size_t i = 0; i < kErrorSources.size(); ++i) {
              precision.parts_ecef.at(i) = parts.at(kErrorSources.at(i));
            }
          },
          "{ErrorSource: (3, 3) [m^2]}; their sum is the bound.");
  m.def("bearing_jacobian", &bearing_jacobian, arg("station"), arg("p_ecef"),
        "(2, 3) derivative of (cross-elevation, elevation) by the position [rad/m].");
  m.def(
      "position_precision",
      [](const std::vector<PlannedStation>& stations, const PlannedTarget& target,
         double exposures) { return position_precision(stations, target, exposures); },
      arg("stations"), arg("target"), arg("exposures") = 1.0,
      "PositionPrecision of a target; None when the stations do not determine it.");
}

void bind_placement(py::module_& m) {
  py::enum_<PlacementGoal>(m, "PlacementGoal", "What a placement makes least.")
      .value("MEAN", PlacementGoal::kMean)
      .value("WORST", PlacementGoal::kWorst);
  data_class<PlacementProblem>(m, "PlacementProblem", "Where to put stations.")
      .def_readwrite("kept", &PlacementProblem::kept, "PlannedStations that stand already.")
      .def_readwrite("places", &PlacementProblem::places, "PlannedStations, each usable once.")
      .def_readwrite("area", &PlacementProblem::area, "PlannedTargets that stand for it.")
      .def_readwrite("stations", &PlacementProblem::stations, "How many to choose.")
      .def_readwrite("goal", &PlacementProblem::goal)
      .def_readwrite("exposures", &PlacementProblem::exposures)
      .def_readwrite("within_m", &PlacementProblem::within_m,
                     "[m] A point with a larger error counts as undetermined.")
      .def_readwrite("starts", &PlacementProblem::starts);
  data_class<Placement>(m, "Placement", "A choice of places.")
      .def_readwrite("chosen", &Placement::chosen)
      .def_readwrite("undetermined", &Placement::undetermined, "Points without a position.")
      .def_readwrite("mean_m", &Placement::mean_m)
      .def_readwrite("worst_m", &Placement::worst_m);
  m.def(
      "place_stations",
      [](const PlacementProblem& problem, std::uint64_t seed) {
        std::mt19937_64 generator(seed);
        return place_stations(problem, generator);
      },
      arg("problem"), arg("seed") = 1, "The best Placement found.");
  m.def("rate_placement", &rate_placement, arg("problem"), arg("chosen"),
        "The Placement of a given choice.");
}

}  // namespace

void bind_precision(py::module_& m) {
  bind_utm(m);
  bind_paper_precision(m);
  bind_bound(m);
  bind_placement(m);
}

}  // namespace ols::python
