#include "calibration/procedure/star_stage.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "calibration/pictures/star_detection.h"

namespace ols::calibration {
namespace {

double share(double x) { return x - std::floor(x); }

// The angle nearest to this one at which the worm stands in this phase (0..1), if the span has any.
double at_phase(double angle_rad, double phase, double turn_rad, double from_rad, double to_rad) {
  double at_rad = turn_rad * (std::round(angle_rad / turn_rad - phase) + phase);
  if (at_rad < from_rad) at_rad += turn_rad;
  if (at_rad > to_rad) at_rad -= turn_rad;
  return std::clamp(at_rad, from_rad, to_rad);
}

}  // namespace

// In even steps the worm looks like an eccentricity, or is seen in a few of its phases only: each
// picture is at the phase that the golden section gives. What turns with the tilt is told best by
// the lowest and the highest pictures, each over one turn of the worm. Of 20 pictures of 12 stars
// that leaves 4.7 arc seconds where unequal steps over all elevations leave 7.2, in the mean
// (docs/calibration.md, bounds).
std::vector<Shot> plan_stars(const StarPlanOptions& o) {
  if (!(o.highest_rad > o.lowest_rad)) {
    throw std::invalid_argument("the unit does not reach the stars: it tilts too little");
  }
  constexpr double kGolden = 0.6180339887498949;
  const double band_rad = std::min(o.worm_turn_rad, o.highest_rad - o.lowest_rad);
  std::vector<Shot> shots;
  for (int i = 0; i < o.pictures; ++i) {
    const double even_rad =
        o.pan_min_rad + (i + 0.5) / o.pictures * (o.pan_max_rad - o.pan_min_rad);
    const double into_band_rad = share(kGolden * (i / 2 + 1)) * band_rad;
    Shot shot;
    shot.angles.pan_rad =
        at_phase(even_rad, share(kGolden * (i + 1)), o.worm_turn_rad, o.pan_min_rad, o.pan_max_rad);
    shot.angles.tilt_rad =
        i % 2 == 0 ? o.lowest_rad + into_band_rad : o.highest_rad - into_band_rad;
    shot.approach_pan = i / 2 % 2 == 0 ? 1 : -1;
    shot.approach_tilt = (i + 1) / 2 % 2 == 0 ? 1 : -1;
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
