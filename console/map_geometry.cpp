#include "console/map_geometry.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "geometry/angles.h"
#include "geometry/chi_square.h"
#include "geometry/geodesic.h"
#include "geometry/mgrs.h"
#include "geometry/utm.h"

namespace ols::console {
namespace {

constexpr double kMostLines = 12.0;  // of each direction
constexpr int kPointsOfALine = 17;
constexpr double kWidestBox_deg = 6.0;

bool is_place(const std::vector<double>& place) {
  return place.size() == 2 && std::abs(place[0]) <= 90.0 && std::abs(place[1]) <= 360.0;
}

Geodetic geodetic(double latitude_deg, double longitude_deg) {
  return {radians(latitude_deg), radians(longitude_deg), 0.0};
}

double step_for(double span_m) {
  double step_m = 10.0;
  while (span_m / step_m > kMostLines) step_m *= 10.0;
  for (const double part : {0.2, 0.5}) {
    if (span_m / (step_m * part) <= kMostLines) return step_m * part;
  }
  return step_m;
}

struct Span {
  double least = 1e12, greatest = -1e12;
  void add(double value) {
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
};

// One line of the grid: `at_m` stays, the other coordinate runs along `along`.
Json grid_line(Utm corner, double at_m, const Span& along, bool is_easting) {
  Json path = Json::array();
  for (int i = 0; i < kPointsOfALine; ++i) {
    const double there = along.least + (along.greatest - along.least) * i / (kPointsOfALine - 1.0);
    corner.easting_m = is_easting ? at_m : there;
    corner.northing_m = is_easting ? there : at_m;
    const Geodetic place = geodetic_from_utm(corner, 0.0);
    path.push_back({degrees(place.longitude_rad), degrees(place.latitude_rad)});
  }
  return {{"at_m", at_m}, {"is_easting", is_easting}, {"path", std::move(path)}};
}

// The names of the squares of 100 km in view, each in the middle of what is seen of it.
Json grid_squares(Utm corner, const Span& easting, const Span& northing) {
  constexpr double kSquare_m = 1e5;
  const auto part = [](const Span& all, double from) {
    return (std::max(all.least, from) + std::min(all.greatest, from + kSquare_m)) / 2;
  };
  const auto first = [](const Span& all) { return std::floor(all.least / kSquare_m) * kSquare_m; };
  Json squares = Json::array();
  for (double east = first(easting); east < easting.greatest; east += kSquare_m) {
    for (double north = first(northing); north < northing.greatest; north += kSquare_m) {
      corner.easting_m = part(easting, east);
      corner.northing_m = part(northing, north);
      const Geodetic middle = geodetic_from_utm(corner, 0.0);
      squares.push_back({{"name", mgrs(middle, 0)},
                         {"at", {degrees(middle.longitude_rad), degrees(middle.latitude_rad)}}});
    }
  }
  return squares;
}

Json grid_of(const std::vector<double>& box) {
  const Utm middle =
      utm_from_geodetic(geodetic((box[1] + box[3]) / 2, (box[0] + box[2]) / 2)).position;
  Span easting, northing;
  for (const double latitude : {box[1], (box[1] + box[3]) / 2, box[3]}) {
    for (const double longitude : {box[0], (box[0] + box[2]) / 2, box[2]}) {
      // Corners in another zone do not count: only this zone is gridded.
      const Utm corner = utm_from_geodetic(geodetic(latitude, longitude)).position;
      if (corner.zone != middle.zone || corner.northern != middle.northern) continue;
      easting.add(corner.easting_m);
      northing.add(corner.northing_m);
    }
  }
  const double step_m =
      step_for(std::max(easting.greatest - easting.least, northing.greatest - northing.least));
  Json lines = Json::array();
  for (double at = std::ceil(easting.least / step_m) * step_m; at <= easting.greatest; at += step_m)
    lines.push_back(grid_line(middle, at, northing, true));
  for (double at = std::ceil(northing.least / step_m) * step_m; at <= northing.greatest;
       at += step_m)
    lines.push_back(grid_line(middle, at, easting, false));
  return {{"zone", middle.zone},
          {"northern", middle.northern},
          {"step_m", step_m},
          {"lines", std::move(lines)},
          {"squares", grid_squares(middle, easting, northing)}};
}

}  // namespace

std::vector<double> numbers_of(std::string_view query, std::string_view name) {
  const auto begin = query.find(name);
  if (begin == std::string_view::npos) return {};
  query.remove_prefix(begin + name.size());
  query = query.substr(0, query.find('&'));
  std::vector<double> numbers;
  while (!query.empty()) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(query.data(), query.data() + query.size(), value);
    if (error != std::errc{} || !std::isfinite(value)) return {};
    numbers.push_back(value);
    query.remove_prefix(static_cast<std::size_t>(end - query.data()));
    if (!query.empty() && query.front() != ',') return {};
    if (!query.empty()) query.remove_prefix(1);
    if (numbers.size() > 4) return {};
  }
  return numbers;
}

Json ellipse95(double ee, double en, double nn) {
  const double middle = (ee + nn) / 2, half = std::hypot((ee - nn) / 2, en);
  const double least = middle - half;
  if (!std::isfinite(middle + half) || !(least >= 0.0)) return nullptr;
  static const double kScale = std::sqrt(chi_square_critical(0.05, 2));
  // The azimuth of the eigenvector of the larger eigenvalue, clockwise from north.
  const double azimuth_rad = 0.5 * std::atan2(2 * en, nn - ee);
  return {{"semi_major_m", kScale * std::sqrt(middle + half)},
          {"semi_minor_m", kScale * std::sqrt(least)},
          {"azimuth_deg", degrees(wrap_two_pi(azimuth_rad))}};
}

std::optional<Json> measure(const std::string& query) {
  const auto from = numbers_of(query, "from="), to = numbers_of(query, "to=");
  if (!is_place(from) || !is_place(to)) return std::nullopt;
  const Geodesic line = geodesic_between(geodetic(from[0], from[1]), geodetic(to[0], to[1]));
  return Json{{"distance_m", line.distance_m},
              {"azimuth_deg", degrees(line.azimuth_rad)},
              {"mgrs", mgrs(geodetic(to[0], to[1]), 5)}};
}

std::optional<Json> utm_grid(const std::string& query) {
  const auto box = numbers_of(query, "box=");
  if (box.size() != 4 || !(box[0] < box[2] && box[1] < box[3])) return std::nullopt;
  const bool is_within = box[0] >= -180 && box[2] <= 180 && box[1] >= -80 && box[3] <= 84;
  if (!is_within || box[2] - box[0] > kWidestBox_deg || box[3] - box[1] > kWidestBox_deg) {
    return std::nullopt;
  }
  try {
    return grid_of(box);
  } catch (const std::invalid_argument&) {
    return std::nullopt;  // beyond its zone
  }
}

}  // namespace ols::console
