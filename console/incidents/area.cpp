#include "console/incidents/area.h"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/special_functions/owens_t.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "base/text/plain_text.h"
#include "conditions/printed.h"
#include "geometry/angles.h"
#include "wire/object_class.h"

namespace ols::console {
namespace {

using Json = nlohmann::json;
using Corners = std::vector<Eigen::Vector2d>;

constexpr std::size_t kMostNameBytes = 40, kMostCorners = 100;
constexpr int kMostClasses = 20;
constexpr double kMostLatitude_deg = 85.0;  // that of the map
constexpr double kMostExtent_deg = 10.0;
constexpr double kLeastHeight_m = -1000.0, kMostHeight_m = 100'000.0;
// Smaller than any real variance; keeps the whitening of a covariance of zero finite.
constexpr double kLeastVariance_m2 = 1e-4;

[[noreturn]] void refuse(const std::string& what) { throw std::invalid_argument(what); }

const Json& field(const Json& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end()) refuse(std::string(key) + " is missing");
  return *found;
}

double number(const Json& value, const std::string& what, double least, double greatest) {
  const double number = value.is_number() ? value.get<double>() : NAN;
  if (number >= least && number <= greatest) return number;
  refuse(what + " must be a number within " + Json(least).dump() + " and " + Json(greatest).dump());
}

// Spaces inside are allowed: people read the name.
std::string name_of(const Json& value) {
  const std::string name = value.is_string() ? value.get<std::string>() : "";
  const bool is_good = !name.empty() && name.size() <= kMostNameBytes && plain_text(name) == name &&
                       name.front() != ' ' && name.back() != ' ';
  if (!is_good) refuse("name must be a text of 1 to 40 bytes");
  return name;
}

std::string class_of(const Json& value) {
  for (const wire::ObjectClassRow& known : wire::kObjectClasses) {
    if (value == known.name) return known.name;
  }
  refuse("unknown class " + value.dump());
}

// "22:30"
int minutes_of(const Json& value, const std::string& what) {
  const std::string text = value.is_string() ? value.get<std::string>() : "";
  const auto digit = [&](std::size_t i) { return text[i] - '0'; };
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (text.size() == 5 && text[2] == ':' && std::ranges::count_if(text, is_digit) == 4) {
    const int hours = 10 * digit(0) + digit(1), minutes = 10 * digit(3) + digit(4);
    if (hours < 24 && minutes < 60) return 60 * hours + minutes;
  }
  refuse(what + " must be a time of day, as 22:30");
}

std::string text_of(int minutes) { return printed("%02d:%02d", minutes / 60 % 24, minutes % 60); }

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// The corners [deg] relative to a place, across the antimeridian where that is the shorter way.
Corners relative_deg(const Area& area, double longitude_deg, double latitude_deg) {
  Corners corners;
  double last_deg = longitude_deg;
  for (const auto& [lon, lat] : area.corners_deg) {
    last_deg += std::remainder(lon - last_deg, 360.0);
    corners.emplace_back(last_deg - longitude_deg, lat - latitude_deg);
  }
  return corners;
}

bool is_crossing(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                 const Eigen::Vector2d& d) {
  const bool ab = (cross(b - a, c - a) > 0.0) != (cross(b - a, d - a) > 0.0);
  const bool cd = (cross(d - c, a - c) > 0.0) != (cross(d - c, b - c) > 0.0);
  return ab && cd;
}

void check_polygon(const Area& area) {
  const Corners corners = relative_deg(area, area.corners_deg[0][0], 0.0);
  const std::size_t n = corners.size();
  double twice_area = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d &a = corners[i], &b = corners[(i + 1) % n];
    twice_area += cross(a - corners[0], b - corners[0]);
    if ((a - corners[0]).cwiseAbs().maxCoeff() > kMostExtent_deg) refuse("polygon is too large");
    for (std::size_t k = i + 2; k < n && !(i == 0 && k == n - 1); ++k) {
      if (is_crossing(a, b, corners[k], corners[(k + 1) % n])) refuse("polygon crosses itself");
    }
  }
  if (twice_area == 0.0) refuse("polygon encloses nothing");
}

void read_polygon(const Json& polygon, Area& area) {
  if (!polygon.is_array() || polygon.size() < 3 || polygon.size() > kMostCorners) {
    refuse("polygon must have 3 to 100 corners");
  }
  for (const Json& corner : polygon) {
    if (!corner.is_array() || corner.size() != 2) {
      refuse("each corner of polygon must be [longitude, latitude]");
    }
    area.corners_deg.push_back(
        {number(corner[0], "a corner's longitude", -540.0, 540.0),
         number(corner[1], "a corner's latitude", -kMostLatitude_deg, kMostLatitude_deg)});
  }
  check_polygon(area);
}

// One edge's part of the probability that a standard normal point is in a polygon: that of the
// triangle of the edge and the origin, signed by the edge's direction around it. Owen's T function
// is the integral of exp(-r^2 / 2) over the triangle's angle, r the distance of its edge.
double edge_probability(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const double length = (b - a).norm();
  const double twice_area = cross(a, b);
  if (length == 0.0 || twice_area == 0.0) return 0.0;
  const double distance = std::abs(twice_area) / length;
  const Eigen::Vector2d along = (b - a) / length;
  const auto to = [&](const Eigen::Vector2d& end) {
    const double tangent = end.dot(along) / distance;
    return std::atan(tangent) / (2.0 * std::numbers::pi) - boost::math::owens_t(distance, tangent);
  };
  return std::copysign(to(b) - to(a), twice_area);
}

// The length [m] of a degree of longitude and one of latitude (the radii of curvature of
// WGS84).
Eigen::Vector2d east_north_m(const Geodetic& at) {
  constexpr double kRadius_m = 6378137.0, kFlattening = 1.0 / 298.257223563;
  constexpr double kSquare = kFlattening * (2.0 - kFlattening);  // of the eccentricity
  const double sine = std::sin(at.latitude_rad);
  const double root = std::sqrt(1.0 - kSquare * sine * sine);
  const double across_m = kRadius_m / root;
  const double along_m = kRadius_m * (1.0 - kSquare) / (root * root * root);
  return radians(1.0) * Eigen::Vector2d((across_m + at.height_m) * std::cos(at.latitude_rad),
                                        along_m + at.height_m);
}

double below(double height_m, double mean_m, double sd_m) {
  return 0.5 * std::erfc((mean_m - height_m) / (sd_m * std::numbers::sqrt2));
}

}  // namespace

Area area_from(const Json& json) {
  if (!json.is_object()) refuse("an area must be an object");
  for (const auto& [key, value] : json.items()) {
    constexpr std::array kKeys{"name", "polygon", "lowest_m", "highest_m", "classes", "from", "to"};
    if (std::ranges::find(kKeys, key) == kKeys.end()) refuse("unknown key " + Json(key).dump());
  }
  Area area;
  area.name = name_of(field(json, "name"));
  read_polygon(field(json, "polygon"), area);
  area.lowest_m = number(field(json, "lowest_m"), "lowest_m", kLeastHeight_m, kMostHeight_m);
  area.highest_m = number(field(json, "highest_m"), "highest_m", kLeastHeight_m, kMostHeight_m);
  if (area.highest_m <= area.lowest_m) refuse("highest_m must be above lowest_m");
  const Json& classes = field(json, "classes");
  if (!classes.is_array() || classes.size() > std::size_t{kMostClasses})
    refuse("classes must be a list");
  for (const Json& object_class : classes) area.classes.push_back(class_of(object_class));
  area.from_min = minutes_of(field(json, "from"), "from");
  area.to_min = minutes_of(field(json, "to"), "to");
  return area;
}

Json json_of(const Area& area) {
  return {{"name", area.name},         {"polygon", area.corners_deg},
          {"lowest_m", area.lowest_m}, {"highest_m", area.highest_m},
          {"classes", area.classes},   {"from", text_of(area.from_min)},
          {"to", text_of(area.to_min)}};
}

bool is_watched(const Area& area, int minute_of_day) {
  if (area.from_min == area.to_min) return true;
  const bool has_begun = minute_of_day >= area.from_min, lasts = minute_of_day < area.to_min;
  return area.from_min < area.to_min ? has_begun && lasts : has_begun || lasts;
}

bool concerns(const Area& area, const std::string& object_class) {
  return area.classes.empty() ||
         std::ranges::find(area.classes, object_class) != area.classes.end();
}

std::optional<double> probability_inside(const Area& area, const Geodetic& position,
                                         const Eigen::Matrix3d& covariance_enu_m2) {
  const Eigen::Matrix2d covariance =
      covariance_enu_m2.topLeftCorner<2, 2>() + kLeastVariance_m2 * Eigen::Matrix2d::Identity();
  const Eigen::LLT<Eigen::Matrix2d> factors(covariance);
  if (factors.info() != Eigen::Success) return std::nullopt;
  const Eigen::Matrix2d root = factors.matrixL();
  const Eigen::Vector2d scale_m = east_north_m(position);
  Corners corners =
      relative_deg(area, degrees(position.longitude_rad), degrees(position.latitude_rad));
  for (Eigen::Vector2d& corner : corners) {
    corner = root.triangularView<Eigen::Lower>().solve(corner.cwiseProduct(scale_m));
  }
  double horizontal = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    horizontal += edge_probability(corners[i], corners[(i + 1) % corners.size()]);
  }
  const double sd_m = std::sqrt(covariance_enu_m2(2, 2) + kLeastVariance_m2);
  const double vertical = below(area.highest_m, position.height_m, sd_m) -
                          below(area.lowest_m, position.height_m, sd_m);
  const double probability = std::abs(horizontal) * vertical;
  if (!std::isfinite(probability)) return std::nullopt;
  return std::min(1.0, probability);
}

}  // namespace ols::console
