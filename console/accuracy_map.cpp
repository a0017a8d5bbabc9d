#include "console/accuracy_map.h"

#include <cmath>
#include <vector>

#include "console/map_geometry.h"
#include "geometry/angles.h"
#include "geometry/precision.h"

namespace ols::console {
namespace {

constexpr double kWidestBox_deg = 3.0;
constexpr double kGreatestHeight_m = 50'000.0;
constexpr double kWorst_m = 1e5;
constexpr std::size_t kMostStations = 32;
constexpr double kOtherwiseWhite_rad = 1e-4;  // for a station that states no field of view

// nullopt: not known.
std::optional<double> number(const Json& station, const char* field) {
  const auto found = station.find(field);
  if (found == station.end() || !found->is_number()) return std::nullopt;
  return found->get<double>();
}

std::optional<double> first_number(const Json& station, const char* field) {
  const auto found = station.find(field);
  if (found == station.end() || !found->is_array() || found->empty()) return std::nullopt;
  if (!found->front().is_number()) return std::nullopt;
  return found->front().get<double>();
}

double pixel_rad(const Json& station) {
  const auto field_deg = first_number(station, "field_of_view_deg");
  const auto width_px = first_number(station, "image_px");
  if (!field_deg || !width_px || *field_deg <= 0.0 || *width_px <= 0.0) return kOtherwiseWhite_rad;
  return radians(*field_deg) / *width_px;
}

struct Site {
  std::vector<PlannedStation> stations;
  double mean_height_m = 0.0;
};

Site site_of(const Json& stations) {
  Site site;
  for (const Json& station : stations) {
    const auto latitude = number(station, "latitude_deg"),
               longitude = number(station, "longitude_deg"), height = number(station, "height_m");
    const bool is_silent = station.value("stale", false);
    if (is_silent || !latitude || !longitude || !height || site.stations.size() >= kMostStations)
      continue;
    CalibrationSd sd;
    sd.heading_rad = radians(number(station, "heading_sd_deg").value_or(0.0));
    sd.tilt_rad = radians(number(station, "tilt_sd_deg").value_or(0.0));
    sd.position_m = first_number(station, "position_sd_m").value_or(0.0);
    site.stations.push_back({LocalFrame({radians(*latitude), radians(*longitude), *height}),
                             pixel_rad(station), sd, 0.0});
    site.mean_height_m += *height;
  }
  if (!site.stations.empty()) site.mean_height_m /= static_cast<double>(site.stations.size());
  return site;
}

Json sd_m(const Site& site, const Geodetic& place) {
  const PlannedTarget target{ecef_from_geodetic(place), Eigen::Matrix3d::Zero()};
  const auto precision = position_precision(site.stations, target);
  if (!precision) return nullptr;
  const double sd = std::sqrt(precision->covariance_ecef.trace());
  if (!std::isfinite(sd) || sd > kWorst_m) return nullptr;
  return std::round(sd * 1000.0) / 1000.0;
}

}  // namespace

std::optional<Json> accuracy_map(const Json& stations, const std::string& query) {
  const auto box = numbers_of(query, "box="), above = numbers_of(query, "above=");
  if (box.size() != 4 || above.size() != 1 || std::abs(above[0]) > kGreatestHeight_m)
    return std::nullopt;
  const double across_deg = box[2] - box[0], along_deg = box[3] - box[1];
  const bool is_box = across_deg > 0.0 && along_deg > 0.0 && across_deg <= kWidestBox_deg &&
                      along_deg <= kWidestBox_deg && std::abs(box[0]) <= 360.0 && box[1] >= -85.0 &&
                      box[3] <= 85.0;
  if (!is_box) return std::nullopt;
  const Site site = site_of(stations);
  const double height_m = site.mean_height_m + above[0];
  Json cells = Json::array();
  for (int row = 0; row < kAccuracyCells; ++row) {
    for (int column = 0; column < kAccuracyCells; ++column) {
      const double latitude_deg = box[3] - along_deg * (row + 0.5) / kAccuracyCells;
      const double longitude_deg = box[0] + across_deg * (column + 0.5) / kAccuracyCells;
      cells.push_back(sd_m(site, {radians(latitude_deg), radians(longitude_deg), height_m}));
    }
  }
  return Json{{"height_m", std::round(height_m)},
              {"columns", kAccuracyCells},
              {"rows", kAccuracyCells},
              {"sd_m", std::move(cells)}};
}

}  // namespace ols::console
