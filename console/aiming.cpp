#include "console/aiming.h"

#include <Eigen/Core>
#include <cmath>

#include "geometry/angles.h"
#include "geometry/direction.h"

namespace ols::console {
namespace {

// NaN: not known.
double value_of(const Json& fields, const char* key) {
  const auto found = fields.find(key);
  return found != fields.end() && found->is_number() ? found->get<double>() : std::nan("");
}

double value_of(const Json& fields, const char* key, std::size_t index) {
  const auto found = fields.find(key);
  if (found == fields.end() || !found->is_array() || found->size() <= index) return std::nan("");
  return (*found)[index].is_number() ? (*found)[index].get<double>() : std::nan("");
}

double angle_rad(const Json& fields, const char* key) { return radians(value_of(fields, key)); }

bool is_within(double value_rad, const Json& fields, const char* limits) {
  const double least_rad = radians(value_of(fields, limits, 0));
  const double most_rad = radians(value_of(fields, limits, 1));
  return !(value_rad < least_rad) && !(value_rad > most_rad);  // unknown limits forbid nothing
}

ChainParameters level_of(const Json& station) {
  ChainParameters chain;
  chain.heading_rad = angle_rad(station, "heading_deg");
  chain.tilt_x_rad = angle_rad(station, "tilt_x_deg");
  chain.tilt_y_rad = angle_rad(station, "tilt_y_deg");
  chain.pan_sign = value_of(station, "pan_sign") < 0 ? -1 : 1;
  chain.tilt_sign = value_of(station, "tilt_sign") < 0 ? -1 : 1;
  return chain;
}

}  // namespace

// A status has neither the zeros of the unit's angles nor the camera's mounting. Both are the same
// in the direction in which the axis points now, so they cancel out of the way from there.
std::optional<PanTilt> aim_at_place(const Json& station, const Geodetic& place) {
  const Eigen::Vector3d camera_ecef{value_of(station, "camera_ecef_m", 0),
                                    value_of(station, "camera_ecef_m", 1),
                                    value_of(station, "camera_ecef_m", 2)};
  const PanTilt now{angle_rad(station, "pan_deg"), angle_rad(station, "tilt_deg")};
  const AzimuthElevation axis{angle_rad(station, "azimuth_deg"),
                              angle_rad(station, "elevation_deg")};
  const ChainParameters chain = level_of(station);
  const double known = camera_ecef.sum() + now.pan_rad + now.tilt_rad + axis.azimuth_rad +
                       axis.elevation_rad + chain.heading_rad + chain.tilt_x_rad + chain.tilt_y_rad;
  if (!std::isfinite(known)) return std::nullopt;
  const Eigen::Vector3d way_enu =
      R_ecef_enu(camera_ecef).transpose() * (ecef_from_geodetic(place) - camera_ecef);
  const auto looking = aim(chain, enu_from_azimuth_elevation(axis));
  const auto wanted = aim(chain, way_enu);
  if (!looking || !wanted) return std::nullopt;
  const double pan_rad = now.pan_rad + wrap_pi(wanted->pan_rad - looking->pan_rad);
  const double tilt_rad = now.tilt_rad + wanted->tilt_rad - looking->tilt_rad;
  if (!is_within(tilt_rad, station, "tilt_limits_deg")) return std::nullopt;
  // The short way round, or the other one where the travel ends.
  for (const double turn_rad : {0.0, -2 * kPi, 2 * kPi}) {
    if (is_within(pan_rad + turn_rad, station, "pan_limits_deg")) {
      return PanTilt{pan_rad + turn_rad, tilt_rad};
    }
  }
  return std::nullopt;
}

}  // namespace ols::console
