#include "sim/scenario/scenario_places.h"

#include <memory>
#include <stdexcept>
#include <utility>

#include "edge/config/config_units.h"

namespace ols::sim {
namespace {

constexpr std::pair<const char*, StationingBy> kWays[] = {{"drawn", StationingBy::kDrawn},
                                                          {"each-other", StationingBy::kEachOther},
                                                          {"landmarks", StationingBy::kLandmarks}};

config::Section landmark_section(std::vector<StationingScenario::Landmark>& landmarks) {
  config::Section section{"landmark", "A landmark that the stations sight, in UTM."};
  section.append = [&landmarks] {
    struct Keys {
      StationingScenario::Landmark landmark;
      UtmPlace place;
    };
    auto keys = std::make_shared<Keys>();
    auto rows = utm_rows(keys->place);
    rows.push_back(config::text("id", keys->landmark.id, "Its name.").required());
    rows.push_back(
        config::number("sd_m", keys->landmark.sd_m, {0.0, 100.0}, "m", "1-sigma of each axis.")
            .required());
    for (config::Row& row : rows)
      if (row.key != "hemisphere") row.presence = config::Presence::kRequired;
    return config::Section{"", "", rows, {}, [keys, &landmarks](ConfigTable& table) {
                             keys->landmark.p_ecef =
                                 ecef_from_geodetic(geodetic(table, keys->place));
                             landmarks.push_back(keys->landmark);
                           }};
  };
  return section;
}

}  // namespace

std::vector<config::Row> utm_rows(UtmPlace& place) {
  return {config::integer("zone", place.utm.zone, 0, 60, "", "UTM zone.").default_is("required"),
          config::word("hemisphere", place.utm.northern, {{"north", true}, {"south", false}},
                       "Hemisphere."),
          config::number("easting_m", place.utm.easting_m, {0.0, 1e6}, "m", "UTM easting.")
              .default_is("required"),
          config::number("northing_m", place.utm.northing_m, {0.0, 1e7}, "m", "UTM northing.")
              .default_is("required"),
          config::number("height_m", place.height_m, {-1000.0, 20000.0}, "m",
                         "Height above the ellipsoid.")
              .default_is("required")};
}

Geodetic geodetic(ConfigTable& table, const UtmPlace& place) {
  try {
    return geodetic_from_utm(place.utm, place.height_m);
  } catch (const std::invalid_argument& problem) {
    throw table.error("zone", problem.what());
  }
}

config::Section stationing_section(StationingScenario& s) {
  return {"stationing",
          "How the stations find their headings.",
          {config::word("by", s.by, {std::begin(kWays), std::end(kWays)},
                        "drawn: not at all, the error is errors.heading; or by sighting each other "
                        "or landmarks."),
           config::number("mark_sd_px", s.mark_sd_px, {0.0, 100.0}, "px",
                          "1-sigma of the operator's mark, each coordinate."),
           config::number("each_other_sd_m", s.each_other_sd_m, {0.0, 100.0}, "m",
                          "1-sigma of the point of a station that the others mark, each axis."),
           config::number("highest_deg", s.highest_rad, {0.0, 80.0}, station::in_degrees(),
                          "Maximum elevation or depression of a sighting.")},
          {landmark_section(s.landmarks)},
          [&s](ConfigTable& table) {
            if (s.by == StationingBy::kLandmarks && s.landmarks.empty())
              throw table.error("by", "the scenario has no landmarks to sight");
          }};
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
  throw std::invalid_argument("unknown stationing '" + by + "'; known ones: " + known);
}

}  // namespace ols::sim
