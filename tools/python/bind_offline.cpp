// Recordings as columns of numpy: Python objects would cost more for each bearing than the filter.
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "base/files/csv_files.h"
#include "central/admission/bearing_check.h"
#include "central/offline/object_separation.h"
#include "central/offline/offline_fusion.h"
#include "geometry/angles.h"
#include "geometry/wgs84.h"
#include "tools/offline/recorded_bearings.h"
#include "tools/python/bindings.h"
#include "tools/python/eigen_caster.h"

namespace ols::python {
namespace {

using py::arg;
using Reals = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Integers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;
using Counts = std::map<std::string, std::int64_t>;

// Made from a shape: from a mere count, Debian's pybind11 2.10 takes the strides from where numpy 1
// had them.
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
  const bool has_aims = given.contains("aim_sd_rad");
  const Reals aim = has_aims ? column<Reals>(given, "aim_sd_rad", n, 1) : Reals();
  for (std::size_t i = 0; i < n; ++i) {
    fusion::BearingMeasurement& row = bearings.rows[i];
    row.sight.origin_ecef = Eigen::Vector3d(centre.data() + 3 * i);
    row.sight.direction = {azimuth.data()[i], elevation.data()[i]};
    row.sight.covariance_white = symmetric(white.data() + 3 * i);
    row.sight.covariance_systematic = symmetric(systematic.data() + 3 * i);
    row.sight.origin_sd_enu_m = Eigen::Vector3d(place_sd.data() + 3 * i);
    if (has_aims) row.sight.aim_sd_rad = aim.data()[i];
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

Reals rows_of(const std::vector<double>& values, std::size_t rows) {
  const auto n = static_cast<py::ssize_t>(rows);
  const auto width = static_cast<py::ssize_t>(values.size()) / std::max<py::ssize_t>(1, n);
  const auto shape = width == 1 ? std::vector<py::ssize_t>{n} : std::vector<py::ssize_t>{n, width};
  return Reals(shape, values.data());
}

// A column of what `take` appends for each row.
template <typename Take>
Reals reals_of(const Bearings& bearings, Take take) {
  std::vector<double> values;
  for (const auto& row : bearings.rows) {
    for (const double value : take(row)) values.push_back(value);
  }
  return rows_of(values, bearings.rows.size());
}

std::array<double, 3> triangle(const Eigen::Matrix2d& m) { return {m(0, 0), m(0, 1), m(1, 1)}; }
std::array<double, 3> triple(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

py::dict columns_of(const Bearings& bearings) {
  using Row = fusion::BearingMeasurement;
  py::list stations;
  std::vector<std::int64_t> utime, boot, track, calibration;
  for (const Row& row : bearings.rows) {
    stations.append(row.station);
    utime.push_back(row.utime_us);
    boot.push_back(static_cast<std::int64_t>(row.boot_id));
    track.push_back(static_cast<std::int64_t>(row.track_id));
    calibration.push_back(static_cast<std::int64_t>(row.calibration_id));
  }
  const auto put = [&](py::dict& to, const char* name, auto take) {
    to[name] = reals_of(bearings, take);
  };
  py::dict columns;
  columns["station"] = stations;
  columns["utime"] = integers(utime);
  columns["boot_id"] = integers(boot);
  columns["track_id"] = integers(track);
  columns["calibration_id"] = integers(calibration);
  put(columns, "azimuth_rad",
      [](const Row& r) { return std::array{r.sight.direction.azimuth_rad}; });
  put(columns, "elevation_rad",
      [](const Row& r) { return std::array{r.sight.direction.elevation_rad}; });
  put(columns, "belief", [](const Row& r) { return std::array{r.belief}; });
  put(columns, "clock_error_s", [](const Row& r) { return std::array{r.clock_sd_s}; });
  put(columns, "camera_ecef_m", [](const Row& r) { return triple(r.sight.origin_ecef); });
  put(columns, "camera_position_sd_m",
      [](const Row& r) { return triple(r.sight.origin_sd_enu_m); });
  put(columns, "covariance_white_rad2",
      [](const Row& r) { return triangle(r.sight.covariance_white); });
  put(columns, "covariance_systematic_rad2",
      [](const Row& r) { return triangle(r.sight.covariance_systematic); });
  put(columns, "aim_sd_rad", [](const Row& r) { return std::array{r.sight.aim_sd_rad}; });
  return columns;
}

// The names in the file's column `target`, one for each bearing; empty without it.
py::tuple read_bearings(const std::string& stations, const std::string& path) {
  offline::RecordedBearings recording = offline::read_recorded_bearings(stations, path);
  for (const auto& target : offline::targets_of(recording)) fusion::guess_clocks(target.bearings);
  py::list targets;
  for (const std::uint32_t number : recording.target_of) {
    targets.append(recording.targets.at(number));
  }
  return py::make_tuple(Bearings{std::move(recording.bearings)}, targets);
}

// Why the fusion would refuse a bearing by itself alone.
fusion::BearingRefusal refusal_of(const fusion::BearingMeasurement& row, double min_belief) {
  const fusion::BearingRefusal why = check(row);
  if (why != fusion::BearingRefusal::kNone) return why;
  return row.belief < min_belief ? fusion::BearingRefusal::kLowBelief : why;
}

Integers check_bearings(const Bearings& bearings) {
  std::vector<std::int64_t> found;
  for (const auto& row : bearings.rows) found.push_back(-static_cast<std::int64_t>(check(row)));
  return integers(found);
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
  py::register_exception<CsvError>(m, "CsvError", PyExc_ValueError);
  py::class_<Bearings>(m, "Bearings", "Many bearings, given as the columns of bearing_t.")
      .def(py::init(&bearings_from), arg("station"),
           "station: list of n names. By keyword, with bearing_t's names and units: utime, "
           "boot_id, track_id, calibration_id, azimuth_rad, elevation_rad, belief, clock_error_s, "
           "each (n,); camera_ecef_m, camera_position_sd_m, (n, 3); covariance_white_rad2, "
           "covariance_systematic_rad2, (n, 3): xx, xy, yy of (cross-elevation, elevation); and, "
           "unless it is unknown, aim_sd_rad, (n,).")
      .def("columns", &columns_of, "{name: (n,) or (n, 3) array}, as they were given.")
      .def("__len__", [](const Bearings& bearings) { return bearings.rows.size(); });
  m.def("read_bearings", &read_bearings, arg("stations"), arg("bearings"),
        "Two files as ols-fuse reads them -> (Bearings, the names in the column `target`, one a "
        "bearing, or none). What the stations' clocks are off by is guessed from the noise. "
        "CsvError, a ValueError, names file, line and column.");
  m.def("check_bearings", &check_bearings, arg("bearings"),
        "Bearings -> (n,) int64: 0 for what can be used, below 0 why not, see REFUSALS: as far as "
        "each bearing alone shows.");
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
