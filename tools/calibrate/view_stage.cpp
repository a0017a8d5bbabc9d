#include "tools/calibrate/view_stage.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "conditions/printed.h"
#include "edge/calibration/view_offset.h"
#include "geometry/angles.h"

namespace ols::calibration {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFewest = 3;  // views
constexpr double kArcsec = kPi / 648000.0;

}  // namespace

std::vector<StoredPicture> views_of(const fs::path& calibration) {
  constexpr double kApart_rad = radians(20.0);
  constexpr std::size_t kMost = 6;
  const std::vector<StoredPicture> all = stored_views(calibration);
  std::vector<StoredPicture> views{all.front()};
  const auto apart = [&views](const StoredPicture& one) {
    double least = std::numeric_limits<double>::infinity();
    for (const StoredPicture& other : views) {
      least = std::min(least, std::abs(one.angles.pan_rad - other.angles.pan_rad));
    }
    return least;
  };
  while (views.size() < kMost) {
    const auto farthest = std::ranges::max_element(all, {}, apart);
    if (apart(*farthest) < kApart_rad) break;
    views.push_back(*farthest);
  }
  return views;
}

std::optional<Order> ViewStage::next() {
  if (at_ >= views_.size()) return std::nullopt;
  const StoredPicture& view = views_[at_];
  Order order;
  order.step = "view " + std::to_string(at_ + 1) + " of " + std::to_string(views_.size()) +
               (again_ ? ", once more" : "");
  order.shot.angles = view.angles;
  order.shot.approach_pan = view.reading.pan.approach;
  order.shot.approach_tilt = view.reading.tilt.approach;
  return order;
}

void ViewStage::taken(const Taken& picture) {
  const StoredPicture& view = views_[at_];
  // A damaged file is one view that is not recognised.
  const cv::Mat stored = cv::imread(view.file.string(), cv::IMREAD_GRAYSCALE);
  const auto offset = station::offset_of({stored, view.angles}, {picture.gray, picture.angles},
                                         model_.geometry, angle_sd_rad_);
  if (offset) {
    remark(printed("pan %7.2f deg: turned %6.1f\" left, %6.1f\" up (1-sigma %.1f\")",
                   degrees(view.angles.pan_rad), offset->left_rad / kArcsec,
                   offset->up_rad / kArcsec, offset->sd_rad / kArcsec));
    offsets_.push_back(*offset);
  } else {
    remark(
        printed("pan %7.2f deg: the stored view is not recognised", degrees(view.angles.pan_rad)));
  }
  step();
}

void ViewStage::not_taken(const std::string& why) {
  remark("a view is missing: " + why);
  step();
}

void ViewStage::step() {
  if (++at_ == views_.size()) end_round();
}

// A difference is reported only if a second round confirms it.
void ViewStage::end_round() {
  is_conclusive_ = offsets_.size() >= kFewest;
  const bool look_again =
      is_conclusive_ && watch_.add(station::find_drift(offsets_, station::motor_steps(model_)));
  if (!look_again || again_) return;
  remark("something differs: all views are taken once more before anything is reported");
  again_ = true;
  at_ = 0;
  offsets_.clear();
}

double ViewStage::progress() const {
  const double share = static_cast<double>(at_) / static_cast<double>(views_.size());
  return again_ ? 0.5 + 0.5 * share : share;
}

bool ViewStage::stands() const {
  return is_conclusive_ && watch_.heading_doubt_rad() == 0.0 && watch_.tilt_doubt_rad() == 0.0;
}

std::string ViewStage::verdict() const {
  if (!is_conclusive_) return "No result: fewer than three views could be compared";
  if (watch_.level() == station::DriftLevel::kNone)
    return "The tripod stands as when it was calibrated";
  const bool red = watch_.level() == station::DriftLevel::kRed;
  return (red ? "RED: " : "AMBER: ") + watch_.alarm().text;
}

}  // namespace ols::calibration
