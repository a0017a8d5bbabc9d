#include "edge/command/watch.h"

#include <algorithm>
#include <cmath>

#include "conditions/alarms.h"
#include "geometry/angles.h"
#include "geometry/lens.h"

namespace ols::station {
namespace {

constexpr double kNew = 0.9;  // share of a picture that its neighbour does not show
constexpr double kThere_rad = radians(0.1);
constexpr double kGoal_s = 0.5;

std::vector<double> middles(double size_rad, double view_rad) {
  const double step_rad = kNew * view_rad;
  const int pictures =
      std::max(1, static_cast<int>(std::ceil((size_rad - view_rad) / step_rad - 1e-9)) + 1);
  std::vector<double> offsets;
  for (int i = 0; i < pictures; ++i) offsets.push_back((i - 0.5 * (pictures - 1)) * step_rad);
  return offsets;
}

}  // namespace

std::vector<AzimuthElevation> pictures_of(const WatchConfig& config,
                                          const Eigen::Vector2d& view_rad) {
  std::vector<AzimuthElevation> pictures;
  if (!config.middle) return pictures;
  bool back = false;
  for (const double up : middles(config.size_rad.y(), view_rad.y())) {
    const double elevation = std::clamp(config.middle->elevation_rad + up, -0.5 * kPi, 0.5 * kPi);
    const double narrow = std::max(std::cos(elevation), 0.01);
    auto row = middles(config.size_rad.x() * narrow, view_rad.x());
    if (back) std::ranges::reverse(row);
    for (const double across : row) {
      pictures.push_back({wrap_two_pi(config.middle->azimuth_rad + across / narrow), elevation});
    }
    back = !back;
  }
  return pictures;
}

std::optional<mount::Goal> Watch::step(double now_s, bool free, bool sees,
                                       const PointingModel& pointing) {
  if (!free || !config_.middle) {
    stands_since_s_.reset();
    return std::nullopt;
  }
  const auto pictures = pictures_of(config_, field_of_view(pointing.geometry().camera));
  judge(now_s, pictures, pointing);
  if (is_over(now_s, sees)) go_on();
  // One that the unit cannot look at is left out.
  std::optional<PanTilt> goal;
  for (std::size_t i = 0; i < pictures.size() && !goal; ++i) {
    picture_ %= pictures.size();
    goal = pointing.aim(pictures[picture_]);
    if (!goal) go_on();
  }
  const auto here = pointing.reported_angles();
  if (!goal || !here) return std::nullopt;
  const bool there = std::abs(here->pan_rad - goal->pan_rad) < kThere_rad &&
                     std::abs(here->tilt_rad - goal->tilt_rad) < kThere_rad;
  if (there && !stands_since_s_) stands_since_s_ = now_s;
  mount::Goal rest{now_s, *goal, {}, now_s + kGoal_s};
  rest.rests = true;
  return rest;
}

void Watch::judge(double now_s, const std::vector<AzimuthElevation>& pictures,
                  const PointingModel& pointing) {
  constexpr double kPeriod_s = 1.0;
  if (now_s < judged_s_ + kPeriod_s) return;
  judged_s_ = now_s;
  all_ = static_cast<int>(pictures.size());
  beyond_reach_ = static_cast<int>(
      std::ranges::count_if(pictures, [&](const auto& one) { return !pointing.aim(one); }));
}

Alarm Watch::alarm() const {
  return beyond_reach_ > 0 ? alarm::watch_out_of_reach(beyond_reach_, all_) : Alarm();
}

bool Watch::is_over(double now_s, bool sees) const {
  if (!stands_since_s_) return false;
  return now_s - *stands_since_s_ >= (sees ? std::max(kLongest_s, config_.stay_s) : config_.stay_s);
}

void Watch::go_on() {
  ++picture_;
  stands_since_s_.reset();
}

}  // namespace ols::station
