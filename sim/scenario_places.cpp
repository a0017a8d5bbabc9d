#include "sim/scenario_places.h"

#include <stdexcept>
#include <utility>

#include "geometry/utm.h"

namespace ols::sim {
namespace {

constexpr std::pair<const char*, StationingBy> kWays[] = {{"drawn", StationingBy::kDrawn},
                                                          {"each-other", StationingBy::kEachOther},
                                                          {"landmarks", StationingBy::kLandmarks}};

}  // namespace

Geodetic read_utm_place(ConfigTable& table) {
  Utm utm;
  utm.zone = static_cast<int>(table.integer("zone", 0, 0, 60));
  utm.northern = table.choice("hemisphere", "north", {"north", "south"}) == "north";
  utm.easting_m = table.required_number("easting_m", 0, 1e6);
  utm.northing_m = table.required_number("northing_m", 0, 1e7);
  const double height_m = table.required_number("height_m", -1000, 20000);
  try {
    return geodetic_from_utm(utm, height_m);
  } catch (const std::invalid_argument& problem) {
    throw table.error("zone", problem.what());
  }
}

StationingScenario read_stationing(ConfigTable& table) {
  StationingScenario s;
  const std::string by = table.text("by", "drawn");
  s.mark_sd_px = table.number("mark_sd_px", s.mark_sd_px, 0, 100);
  s.each_other_sd_m = table.number("each_other_sd_m", s.each_other_sd_m, 0, 100);
  s.highest_rad = radians(table.number("highest_deg", degrees(s.highest_rad), 0, 80));
  for (ConfigTable* row : table.tables("landmark")) {
    const std::string id = row->required_text("id");
    const double sd_m = row->required_number("sd_m", 0, 100);
    s.landmarks.push_back({id, ecef_from_geodetic(read_utm_place(*row)), sd_m});
  }
  try {
    choose_stationing(s, by);
  } catch (const std::invalid_argument& problem) {
    throw table.error("by", problem.what());
  }
  return s;
}

void choose_stationing(StationingScenario& stationing, const std::string& by) {
  std::string known;
  for (const auto& [name, way] : kWays) {
    if (by == name) {
      if (way == StationingBy::kLandmarks && stationing.landmarks.empty()) {
        throw std::invalid_argument("the scenario has no landmarks to sight");
      }
      stationing.by = way;
      return;
    }
    known += std::string(known.empty() ? "" : ", ") + name;
  }
  throw std::invalid_argument("there is no stationing '" + by + "'; there are " + known);
}

}  // namespace ols::sim
