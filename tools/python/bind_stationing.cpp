// Stationing and rectification, for Python.
#include <pybind11/stl.h>

#include "calibration/stationing.h"
#include "tools/python/bindings.h"
#include "tools/python/eigen_caster.h"

namespace ols::python {

using namespace calibration;
using py::arg;

void bind_stationing(py::module_& m) {
  data_class<LandmarkSighting>(m, "LandmarkSighting", "A landmark in a station's picture.")
      .def_readwrite("landmark_ecef", &LandmarkSighting::landmark_ecef, "(3,) [m]")
      .def_readwrite("landmark_sd_m", &LandmarkSighting::landmark_sd_m, "Of each axis.")
      .def_readwrite("pixel", &LandmarkSighting::pixel, "(2,)")
      .def_readwrite("pixel_sd_px", &LandmarkSighting::pixel_sd_px, "Of each coordinate.")
      .def_readwrite("angles", &LandmarkSighting::angles, "PanTilt, as reported.")
      .def_readwrite("angles_sd_rad", &LandmarkSighting::angles_sd_rad, "Of each of them.");
  data_class<LandmarkTest>(m, "LandmarkTest", "The w-test of a landmark's sightings.")
      .def_readwrite("sightings", &LandmarkTest::sightings, "Their indices.")
      .def_readwrite("set_aside", &LandmarkTest::rejected)
      .def_readwrite("w", &LandmarkTest::w)
      .def_readwrite("critical", &LandmarkTest::critical)
      .def_readwrite("detectable_m", &LandmarkTest::detectable_m, "(2,) across and up.");
  data_class<ModelTest>(m, "GlobalTest", "Of what is not set aside.")
      .def_readwrite("variance_factor", &ModelTest::variance_factor)
      .def_readwrite("critical", &ModelTest::critical)
      .def_readwrite("redundancy", &ModelTest::redundancy);
  data_class<Stationing>(m, "Stationing", "A station's pose as landmarks show it.")
      .def_readwrite("station", &Stationing::station, "StationGeometry with its sd.")
      .def_readwrite("covariance", &Stationing::covariance,
                     "(6, 6) [rad^2] heading, tilt x, tilt y, mount z, mount x, mount y.")
      .def_readwrite("residuals", &Stationing::residuals, "(2,) of each sighting, normalised.")
      .def_readwrite("residuals_rad", &Stationing::residuals_rad, "(2,) of each sighting.")
      .def_readwrite("landmarks", &Stationing::landmarks, "LandmarkTest of each.")
      .def_readwrite("global_test", &Stationing::global)
      .def_readwrite("scaled_by", &Stationing::scaled_by, "The deviations, for the global test.");
  m.def(
      "station_by_landmarks",
      [](const StationGeometry& rough, const std::vector<LandmarkSighting>& sightings,
         double highest_rad) { return station_by_landmarks(rough, sightings, highest_rad); },
      arg("rough"), arg("sightings"), arg("highest_rad"),
      "Stationing from sightings; see calibration/stationing.h. ValueError, naming the sighting.");
}

}  // namespace ols::python
