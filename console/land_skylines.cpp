#include "console/land_skylines.h"

#include <utility>

#include "console/land_answers.h"
#include "console/rounded.h"
#include "geometry/angles.h"
#include "land/horizon_map.h"

namespace ols::console {
namespace {

constexpr std::size_t kMostSkylines = 200;  // as many as stations

WebResponse being_computed() { return land_said(202, Json{{"computing", true}}.dump()); }

Json ecef_json(const Eigen::Vector3d& p) {
  return {rounded(p.x(), 3), rounded(p.y(), 3), rounded(p.z(), 3)};
}

}  // namespace

LandSkylines::Answer LandSkylines::answer(const LandTask& task) {
  if (!terrain_) return {no_land()};
  const Eigen::Vector3d camera_ecef = ecef_from_geodetic(task.camera);
  const auto known = kept_.find(task.station);
  if (known != kept_.end()) {  // one at a time for each station, however it moves
    const Kept& kept = known->second;
    if (!kept.response) return {being_computed()};
    if ((kept.camera_ecef - camera_ecef).norm() <= kMoved_m) return {*kept.response};
  } else if (kept_.size() >= kMostSkylines) {
    kept_.clear();
  }
  kept_[task.station] = {camera_ecef, std::nullopt};
  return {being_computed(), true};
}

WebResponse LandSkylines::compute(const LandTask& task) const {
  return land_answer([&]() -> Json {
    const land::HorizonMap map(*terrain_, task.camera);
    const int columns = map.config().columns;
    Json elevations = Json::array();
    for (int column = 0; column < columns; ++column) {
      const auto skyline = map.skyline(2.0 * kPi * column / columns);
      elevations.push_back(skyline ? angle_deg(skyline->elevation_rad) : Json(nullptr));
    }
    return {{"version", version_},
            {"camera_ecef_m", ecef_json(ecef_from_geodetic(task.camera))},
            {"elevation_deg", std::move(elevations)}};
  });
}

void LandSkylines::keep(const LandTask& task, WebResponse response) {
  const auto known = kept_.find(task.station);
  // Dropped if a skyline from another place was asked for meanwhile.
  if (known == kept_.end() || known->second.camera_ecef != ecef_from_geodetic(task.camera)) return;
  if (response.status == 500) {  // it may succeed for the next one who asks
    kept_.erase(known);
  } else {
    known->second.response = std::move(response);
  }
}

}  // namespace ols::console
