#include "console/land_task.h"

#include <cmath>

#include "console/map_geometry.h"

namespace ols::console {
namespace {

constexpr double kWidestLand_deg = 3.0, kHighest_m = 100'000.0;

bool has_place(const std::vector<double>& numbers) {
  return numbers.size() >= 2 && std::abs(numbers[0]) <= 90.0 && std::abs(numbers[1]) <= 360.0;
}

bool is_box(const std::vector<double>& box) {
  return box.size() == 4 && box[0] < box[2] && box[1] < box[3] &&
         box[2] - box[0] <= kWidestLand_deg && box[3] - box[1] <= kWidestLand_deg &&
         std::abs(box[0]) <= 360.0 && box[1] >= -90.0 && box[3] <= 90.0;
}

}  // namespace

std::optional<Geodetic> camera_of(const Json& station) {
  const auto known = station.find("camera_ecef_m");
  if (known == station.end()) return std::nullopt;
  Eigen::Vector3d p_ecef;
  for (int i = 0; i < 3; ++i) {
    const Json& value = known->at(static_cast<std::size_t>(i));
    if (!value.is_number()) return std::nullopt;
    p_ecef(i) = value;
  }
  if (p_ecef.isZero()) return std::nullopt;
  return geodetic_from_ecef(p_ecef);
}

std::optional<LandTask> land_task(std::string_view path, std::string_view query) {
  using What = LandTask::What;
  if (path == "/api/land") return LandTask{};
  if (path == "/api/land/ground") {
    LandTask task{.what = What::kGround, .numbers = numbers_of(query, "at=")};
    if (has_place(task.numbers) && task.numbers.size() == 2) return task;
  }
  if (path == "/api/land/heights") {
    LandTask task{.what = What::kHeights, .numbers = numbers_of(query, "box=")};
    if (is_box(task.numbers)) return task;
  }
  return std::nullopt;
}

std::optional<LandTask> land_task(std::string_view what, std::string_view query,
                                  const std::string& station, const Geodetic& camera) {
  LandTask task{.station = station, .camera = camera};
  if (what == "skyline") {
    task.what = LandTask::What::kSkyline;
    return task;
  }
  task.what = LandTask::What::kProfile;
  task.numbers = numbers_of(query, "to=");
  const auto& to = task.numbers;
  const bool is_known =
      has_place(to) && to.size() <= 3 && (to.size() == 2 || std::abs(to[2]) <= kHighest_m);
  return what == "profile" && is_known ? std::optional(task) : std::nullopt;
}

}  // namespace ols::console
