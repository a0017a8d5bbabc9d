// Recordings as columns of numpy: what the objects of Python would cost for each bearing is more
// than the filter takes for it.
#include <pybind11/stl.h>

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "central/admission/bearing_check.h"
#include "central/offline/object_separation.h"
#include "central/offline/offline_fusion.h"
#include "geometry/angles.h"
#include "geometry/wgs84.h"
#include "tools/python/bindings.h"
#include "tools/python/eigen_caster.h"

namespace ols::python {
namespace {

using py::arg;
using Reals = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Integers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;
using Counts = std::map<std::string, std::int64_t>;

// By its shape: from a count alone, Debian's pybind11 2.10 takes the strides from where numpy 1 had
// them.
Integers integers(const std::vector<std::int64_t>& values) {
  return Integers(std::vector<py::ssize_t>{static_cast<py::ssize_t>(values.size())}, values.data());
}

struct Bearings {
  std::vector<fusion::BearingMeasurement> rows;
};

// A column of the keyword arguments, with as many rows as there are names of stations.
template <typename Array>
Array column(const py::kwargs& columns, const char* name, std::size_t rows, std::size_t width) {
  if (!columns.contains(name)) throw py::type_error(std::string("no column ") + name);
  const auto array = columns[name].cast<Array>();
  const bool fits =
      width == 1 ? array.ndim() == 1 : array.ndim() == 2 && array.shape(1) == py::ssize_t(width);
  if (!fits || array.shape(0) != py::ssize_t(rows)) {
    throw py::value_error(std::string("column ") + name + " must have " + std::to_string(rows) +
                          " rows of " + std::to_string(width));
  }
  return array;
}

Eigen::Matrix2d symmetric(const double* xx_xy_yy) {
  Eigen::Matrix2d matrix;
  matrix << xx_xy_yy[0], xx_xy_yy[1], xx_xy_yy[1], xx_xy_yy[2];
  return matrix;
}

void take_identities(const py::kwargs& given, Bearings& bearings) {
  const std::size_t n = bearings.rows.size();
  const auto utime = column<Integers>(given, "utime", n, 1);
  const auto boot = column<Integers>(given, "boot_id", n, 1);
  const auto track = column<Integers>(given, "track_id", n, 1);
  const auto calibration = column<Integers>(given, "calibration_id", n, 1);
  for (std::size_t i = 0; i < n; ++i) {
    fusion::BearingMeasurement& row = bearings.rows[i];
    row.utime_us = utime.data()[i];
    row.boot_id = boot.data()[i];
    row.track_id = track.data()[i];
    row.calibration_id = calibration.data()[i];
  }
}

void take_sights(const py::kwargs& given, Bearings& bearings) {
  const std::size_t n = bearings.rows.size();
  const auto centre = column<Reals>(given, "camera_ecef_m", n, 3);
  const auto azimuth = column<Reals>(given, "azimuth_rad", n, 1);
  const auto elevation = column<Reals>(given, "elevation_rad", n, 1);
  const auto white = column<Reals>(given, "covariance_white_rad2", n, 3);
  const auto systematic = column<Reals>(given, "covariance_systematic_rad2", n, 3);
  const auto place_sd = column<Reals>(given, "camera_position_sd_m", n, 3);
  const auto belief = column<Reals>(given, "belief", n, 1);
  const auto clock = column<Reals>(given, "clock_error_s", n, 1);
  for (std::size_t i = 0; i < n; ++i) {
    fusion::BearingMeasurement& row = bearings.rows[i];
    row.sight.origin_ecef = Eigen::Vector3d(centre.data() + 3 * i);
    row.sight.direction = {azimuth.data()[i], elevation.data()[i]};
    row.sight.covariance_white = symmetric(white.data() + 3 * i);
    row.sight.covariance_systematic = symmetric(systematic.data() + 3 * i);
    row.sight.origin_sd_enu_m = Eigen::Vector3d(place_sd.data() + 3 * i);
    row.belief = belief.data()[i];
    row.clock_sd_s = clock.data()[i];
  }
}

Bearings bearings_from(const std::vector<std::string>& stations, const py::kwargs& columns) {
  Bearings bearings;
  bearings.rows.resize(stations.size());
  for (std::size_t i = 0; i < stations.size(); ++i) bearings.rows[i].station = stations[i];
  take_identities(columns, bearings);
  take_sights(columns, bearings);
  return bearings;
}

// Why the fusion would refuse a bearing by itself alone.
fusion::BearingRefusal refusal_of(const fusion::BearingMeasurement& row, double min_belief) {
  const fusion::BearingRefusal why = check(row);
  if (why != fusion::BearingRefusal::kNone) return why;
  return row.belief < min_belief ? fusion::BearingRefusal::kLowBelief : why;
}

// Above 0: the object; 0: none; below 0: refused, for the reason of that number.
std::vector<std::int64_t> objects_of(Bearings& bearings, const fusion::FusionConfig& config) {
  std::vector<std::int64_t> objects(bearings.rows.size(), 0);
  fusion::MutableBearings usable;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    objects[i] =
        -static_cast<std::int64_t>(refusal_of(bearings.rows[i], config.admission.min_belief));
    if (objects[i] == 0) usable.push_back(&bearings.rows[i]);
  }
  const auto found = fusion::separate_objects(usable, config, {});
  for (const auto& [object, own] : found.objects) {
    for (const auto* row : own) {
      objects[static_cast<std::size_t>(row - bearings.rows.data())] = object;
    }
  }
  return objects;
}

Integers separate(Bearings& bearings, const fusion::FusionConfig& config) {
  std::vector<std::int64_t> objects;
  {
    const py::gil_scoped_release others_may_run;
    objects = objects_of(bearings, config);
  }
  return integers(objects);
}

std::map<std::int64_t, std::string> refusals() {
  std::map<std::int64_t, std::string> names;
  for (std::int64_t i = 1; i < static_cast<std::int64_t>(fusion::BearingRefusal::kCount); ++i) {
    names[-i] = to_string(static_cast<fusion::BearingRefusal>(i));
  }
  return names;
}

// Rows of a result, one array a column.
class Fixes {
 public:
  void add(const fusion::FusedTarget& target) {
    const fusion::Estimate& estimate = target.estimate;
    const Geodetic place = geodetic_from_ecef(estimate.position_ecef);
    const Eigen::Matrix3d R = R_ecef_enu(place);
    utime_.push_back(target.utime_us);
    const auto used = std::ranges::count_if(target.stations, &fusion::ContributingStation::used);
    used_.push_back(used);
    set_aside_.push_back(static_cast<std::int64_t>(target.stations.size()) - used);
    put(place_, {degrees(place.latitude_rad), degrees(place.longitude_rad), place.height_m});
    put(position_, estimate.position_ecef);
    put(velocity_, estimate.velocity_ecef);
    put(covariance_, triangle(R.transpose() * estimate.covariance_ecef * R));
    put(white_, triangle(R.transpose() * estimate.covariance_white_ecef * R));
    put(quality_, {estimate.crossing_angle_rad, estimate.residual});
  }

  py::dict columns() const {
    py::dict result;
    result["utime"] = integers(utime_);
    result["place"] = matrix(place_, 3);
    result["position_ecef_m"] = matrix(position_, 3);
    result["velocity_ecef_m_s"] = matrix(velocity_, 3);
    result["position_covariance_enu_m2"] = matrix(covariance_, 6);
    result["position_covariance_white_enu_m2"] = matrix(white_, 6);
    result["quality"] = matrix(quality_, 2);
    result["stations_used"] = integers(used_);
    result["stations_set_aside"] = integers(set_aside_);
    return result;
  }

 private:
  static std::array<double, 6> triangle(const Eigen::Matrix3d& m) {
    return {m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)};
  }
  template <std::size_t N>
  static void put(std::vector<double>& to, const std::array<double, N>& values) {
    to.insert(to.end(), values.begin(), values.end());
  }
  static void put(std::vector<double>& to, const Eigen::Vector3d& v) {
    put(to, std::array{v.x(), v.y(), v.z()});
  }
  static void put(std::vector<double>& to, std::initializer_list<double> values) {
    to.insert(to.end(), values);
  }
  py::ssize_t size() const { return static_cast<py::ssize_t>(utime_.size()); }
  Reals matrix(const std::vector<double>& values, py::ssize_t width) const {
    return Reals(std::vector<py::ssize_t>{size(), width}, values.data());
  }

  std::vector<std::int64_t> utime_, used_, set_aside_;
  std::vector<double> place_, position_, velocity_, covariance_, white_, quality_;
};

py::tuple fuse(Bearings& bearings, const Integers& chosen, const fusion::OfflineConfig& config) {
  fusion::BearingPointers usable;
  for (py::ssize_t i = 0; i < chosen.size(); ++i) {
    const auto& row = bearings.rows.at(static_cast<std::size_t>(chosen.data()[i]));
    if (check(row) == fusion::BearingRefusal::kNone) usable.push_back(&row);
  }
  Fixes fixes;
  fusion::OfflineReport report;
  {
    const py::gil_scoped_release others_may_run;
    report = fusion::fuse_offline(usable, config,
                                  [&](const fusion::FusedTarget& target) { fixes.add(target); });
  }
  Counts unlocated;
  for (const auto& [why, count] : report.unlocated) {
    unlocated[to_string(why)] = static_cast<std::int64_t>(count);
  }
  return py::make_tuple(fixes.columns(), unlocated, report.beside);
}

}  // namespace

void bind_offline(py::module_& m) {
  py::class_<Bearings>(m, "Bearings", "Many bearings, given as the columns of bearing_t.")
      .def(py::init(&bearings_from), arg("station"),
           "station: list of n names. By keyword, with bearing_t's names and units: utime, "
           "boot_id, track_id, calibration_id, azimuth_rad, elevation_rad, belief, clock_error_s, "
           "each (n,); camera_ecef_m, camera_position_sd_m, (n, 3); covariance_white_rad2, "
           "covariance_systematic_rad2, (n, 3): xx, xy, yy of (cross-elevation, elevation).")
      .def("__len__", [](const Bearings& bearings) { return bearings.rows.size(); });
  m.def("separate_objects", &separate, arg("bearings"), arg("config") = fusion::FusionConfig{},
        "Bearings -> (n,) int64: the object that each belongs to, by the live tracks' association "
        "looked at afterwards; 0: none; below 0: refused, see REFUSALS.");
  m.attr("REFUSALS") = refusals();
  m.def("fuse_columns", &fuse, arg("bearings"), arg("chosen"),
        arg("config") = fusion::OfflineConfig{},
        "Bearings, (k,) indices of those of one object -> (columns of the n positions, in order of "
        "time; {reason: instants without a position}; {station: why it points elsewhere}). "
        "Columns: utime (n,) [us]; place (n, 3) [deg, deg, m above the ellipsoid]; "
        "position_ecef_m, velocity_ecef_m_s (n, 3); position_covariance_enu_m2 and "
        "position_covariance_white_enu_m2 (n, 6): ee en eu nn nu uu; quality (n, 2): crossing "
        "angle [rad], residual; stations_used, stations_set_aside (n,).");
}

}  // namespace ols::python
