#include "geometry/wgs84.h"

#include <GeographicLib/Geocentric.hpp>
#include <vector>

#include "geometry/angles.h"

namespace ols {
namespace {

using RowMajorMatrix3d = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

Eigen::Matrix3d matrix_from(const std::vector<double>& row_major) {
  return Eigen::Map<const RowMajorMatrix3d>(row_major.data());
}

}  // namespace

Eigen::Vector3d ecef_from_geodetic(const Geodetic& position) {
  Eigen::Vector3d p_ecef;
  GeographicLib::Geocentric::WGS84().Forward(degrees(position.latitude_rad),
                                             degrees(position.longitude_rad), position.height_m,
                                             p_ecef.x(), p_ecef.y(), p_ecef.z());
  return p_ecef;
}

Geodetic geodetic_from_ecef(const Eigen::Vector3d& p_ecef) {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double height_m = 0.0;
  GeographicLib::Geocentric::WGS84().Reverse(p_ecef.x(), p_ecef.y(), p_ecef.z(), latitude_deg,
                                             longitude_deg, height_m);
  return {radians(latitude_deg), radians(longitude_deg), height_m};
}

Eigen::Matrix3d R_ecef_enu(const Geodetic& position) {
  Eigen::Vector3d p_ecef;
  std::vector<double> row_major(9);
  GeographicLib::Geocentric::WGS84().Forward(degrees(position.latitude_rad),
                                             degrees(position.longitude_rad), position.height_m,
                                             p_ecef.x(), p_ecef.y(), p_ecef.z(), row_major);
  return matrix_from(row_major);
}

Eigen::Matrix3d R_ecef_enu(const Eigen::Vector3d& p_ecef) {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double height_m = 0.0;
  std::vector<double> row_major(9);
  GeographicLib::Geocentric::WGS84().Reverse(p_ecef.x(), p_ecef.y(), p_ecef.z(), latitude_deg,
                                             longitude_deg, height_m, row_major);
  return matrix_from(row_major);
}

LocalFrame::LocalFrame(const Geodetic& origin)
    : origin_(origin),
      origin_ecef_(ecef_from_geodetic(origin)),
      R_ecef_enu_(ols::R_ecef_enu(origin)) {}

Eigen::Vector3d LocalFrame::to_enu(const Eigen::Vector3d& p_ecef) const {
  return R_ecef_enu_.transpose() * (p_ecef - origin_ecef_);
}

Eigen::Vector3d LocalFrame::to_ecef(const Eigen::Vector3d& p_enu) const {
  return origin_ecef_ + R_ecef_enu_ * p_enu;
}

}  // namespace ols
