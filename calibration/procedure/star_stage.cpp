#include "calibration/procedure/star_stage.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "calibration/pictures/star_detection.h"

namespace ols::calibration {

std::vector<Shot> plan_stars(const StarPlanOptions& o) {
  if (!(o.highest_rad > o.lowest_rad)) {
    throw std::invalid_argument("the unit does not reach the stars: it tilts too little");
  }
  constexpr double kGolden = 0.6180339887498949, kUneven = 0.3;
  const auto share = [](double x) { return x - std::floor(x); };
  std::vector<Shot> shots;
  for (int i = 0; i < o.pictures; ++i) {
    const double even = (i + 0.5 + kUneven * (share(kGolden * (i + 1)) - 0.5)) / o.pictures;
    Shot shot;
    shot.angles.pan_rad = o.pan_min_rad + even * (o.pan_max_rad - o.pan_min_rad);
    shot.angles.tilt_rad =
        o.lowest_rad + share(kGolden * (3 * i + 2)) * (o.highest_rad - o.lowest_rad);
    shot.approach_pan = i % 2 == 0 ? 1 : -1;
    shot.approach_tilt = i % 4 < 2 ? 1 : -1;
    shots.push_back(shot);
  }
  return shots;
}

std::optional<Order> StarStage::next() {
  if (at_ >= shots_.size()) return std::nullopt;
  Order order;
  order.step = "stars, picture " + std::to_string(at_ + 1) + " of " + std::to_string(shots_.size());
  order.shot = shots_[at_];
  return order;
}

void StarStage::taken(const Taken& picture) {
  constexpr std::size_t kMost = 20;  // the brightest; the faint ones add noise
  const StarField field = detect_stars(picture.gray);
  if (field.stars.empty()) ++empty_;
  for (std::size_t i = 0; i < std::min(kMost, field.stars.size()); ++i) {
    const DetectedStar& star = field.stars[i];
    observations_.push_back(observation_of(Kind::kStar, picture, star.centre_px, star.sd_px, ""));
  }
  step();
}

void StarStage::not_taken(const std::string& why) {
  remark("stars: picture " + std::to_string(at_ + 1) + " is missing: " + why);
  step();
}

void StarStage::step() {
  if (++at_ < shots_.size() || empty_ == 0) return;
  remark("stars: " + std::to_string(empty_) + " of " + std::to_string(shots_.size()) +
         " pictures show none: clouds, or too short an exposure");
}

double StarStage::progress() const {
  return shots_.empty() ? 1.0 : static_cast<double>(at_) / static_cast<double>(shots_.size());
}

}  // namespace ols::calibration
