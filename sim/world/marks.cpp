#include "sim/world/marks.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/config/config_section.h"

namespace ols::sim {

config::Section mark_section(std::vector<Mark>& marks) {
  config::Section section{"mark", "A landmark that the cameras see."};
  section.append = [&marks] {
    auto mark = std::make_shared<Mark>();
    constexpr double kFar_m = 1e6;
    return config::Section{
        "",
        "",
        {config::text("id", mark->id, "Its name.").required(),
         config::numbers("position_enu_m", {mark->p_enu.data(), 3}, {-kFar_m, kFar_m}, "m",
                         "Its place in the site's frame.")
             .required(),
         config::number("size_m", mark->size_m, {0.01, 100.0}, "m", "Its diameter.")},
        {},
        [mark, &marks](ConfigTable& table) {
          const bool twice =
              std::ranges::any_of(marks, [&](const Mark& other) { return other.id == mark->id; });
          if (twice) throw table.error("id", "names two marks");
          marks.push_back(*mark);
        }};
  };
  return section;
}

void draw_mark(const Eigen::Vector2d& centre_px, double radius_px, cv::Mat& gray) {
  constexpr double kLeast_px = 2.0;  // a lamp: smaller ones are drawn so large
  constexpr double kWhite = 245.0, kDark = 20.0, kRim = 1.5;
  const double radius = std::max(kLeast_px, radius_px), outer = kRim * radius;
  const int x0 = std::max(0, static_cast<int>(std::floor(centre_px.x() - outer)) - 1);
  const int y0 = std::max(0, static_cast<int>(std::floor(centre_px.y() - outer)) - 1);
  const int x1 = std::min(gray.cols - 1, static_cast<int>(std::ceil(centre_px.x() + outer)) + 1);
  const int y1 = std::min(gray.rows - 1, static_cast<int>(std::ceil(centre_px.y() + outer)) + 1);
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const double distance = (Eigen::Vector2d(x, y) - centre_px).norm();
      const double white = std::clamp(radius - distance + 0.5, 0.0, 1.0);
      const double covered = std::clamp(outer - distance + 0.5, 0.0, 1.0);
      auto& pixel = gray.at<std::uint8_t>(y, x);
      const double value = pixel * (1.0 - covered) + white * kWhite + (covered - white) * kDark;
      pixel = static_cast<std::uint8_t>(std::lround(value));
    }
  }
}

}  // namespace ols::sim
