#include "edge/station/followed_target.h"

#include <cmath>
#include <map>
#include <string>

namespace ols::station {
namespace {

tracker::ColourPicture colour_of(const camera::Frame& frame) {
  using tracker::ColourLayout;
  static const std::map<std::string, ColourLayout> layouts{
      {"BGR8", ColourLayout::kBgr},         {"RGB8", ColourLayout::kRgb},
      {"BayerRG8", ColourLayout::kBayerRg}, {"BayerGR8", ColourLayout::kBayerGr},
      {"BayerGB8", ColourLayout::kBayerGb}, {"BayerBG8", ColourLayout::kBayerBg}};
  const auto layout = layouts.find(frame.pixel_format);
  if (frame.raw.empty() || layout == layouts.end()) return {};
  return {frame.raw, layout->second};
}

tracker::TrackerInput input_of(const camera::Frame& frame) {
  return {frame.gray, frame.mid_exposure_s, std::nullopt, colour_of(frame)};
}

double size_px(const cv::Rect2d& box) { return std::sqrt(box.area()); }

}  // namespace

void FollowedTarget::begin(Kind kind, double time_s, const cv::Rect2d& box) {
  kind_ = kind;
  track_id_ = new_track_id();
  tracked_s_ = time_s;
  first_size_px_ = size_px(box);
  last_output_.reset();
}

std::optional<tracker::TrackerError> FollowedTarget::designate(const camera::Frame& frame,
                                                               const cv::Rect2d& box) {
  const auto error = tracker_->initialise(input_of(frame), box);
  if (error) return error;
  begin(Kind::kDesignated, frame.mid_exposure_s, box);
  own_.reset();
  return std::nullopt;
}

bool FollowedTarget::try_found(const camera::Frame& frame, const cv::Rect2d& box) {
  const bool has_own = exists();
  if (has_own) tracker_->set_aside();
  if (tracker_->initialise(input_of(frame), box)) {
    if (has_own) tracker_->take_back();
    return false;
  }
  if (has_own) own_ = Own{kind_, track_id_, tracked_s_, first_size_px_};
  begin(Kind::kUnproven, frame.mid_exposure_s, box);
  found_s_ = frame.mid_exposure_s;
  counters_["acquisitions"] += 1;
  return true;
}

void FollowedTarget::confirm() {
  if (on_trial()) kind_ = Kind::kAcquired;
  own_.reset();
}

FollowedTarget::Dropped FollowedTarget::drop_unproven(double time_s) {
  constexpr double kTrial_s = 1.0;
  if (!on_trial() || time_s - found_s_ < kTrial_s) return Dropped::kNothing;
  counters_["acquisitions_dropped"] += 1;
  if (!own_) {
    kind_ = Kind::kNone;
    return Dropped::kNothingLeft;
  }
  tracker_->take_back();
  kind_ = own_->kind;
  track_id_ = own_->track_id;
  tracked_s_ = own_->tracked_s;
  first_size_px_ = own_->first_size_px;
  own_.reset();
  last_output_.reset();
  return Dropped::kBackToOwn;
}

std::optional<tracker::TrackerOutput> FollowedTarget::track(const camera::Frame& frame,
                                                            const PointingModel& pointing) {
  tracker::TrackerInput input = input_of(frame);
  if (tracked_s_) {
    input.predicted_homography = pointing.homography(*tracked_s_, frame.mid_exposure_s);
  }
  const tracker::TrackerResult result = tracker_->track(input);
  if (!result.output) {
    counters_[std::string("frames_refused_") + to_string(*result.error)] += 1;
    return std::nullopt;
  }
  tracked_s_ = frame.mid_exposure_s;
  last_output_ = result.output;
  counters_["frames_tracked"] += 1;
  compare_motion(*result.output);
  return result.output;
}

bool FollowedTarget::let_go(std::int64_t track_id) {
  if (own_ && own_->track_id == track_id) own_.reset();
  if (!exists() || track_id_ != track_id) return false;
  kind_ = Kind::kNone;
  own_.reset();
  last_output_.reset();
  return true;
}

// Compares the camera's motion by the PTU's angles with that of the image: wrong angles, times or
// mounting show here before they affect a position.
void FollowedTarget::compare_motion(const tracker::TrackerOutput& output) {
  if (output.prediction_dropped) counters_["predictions_dropped"] += 1;
  if (!output.prediction_error_px) return;
  const bool disagree = *output.prediction_error_px > config_.prediction_error_px;
  if (disagree) counters_["predictions_disagreeing"] += 1;
  disagreeing_in_a_row_ = disagree ? disagreeing_in_a_row_ + 1 : 0;
}

void FollowedTarget::forget_angles() {
  tracked_s_.reset();
  if (own_) own_->tracked_s.reset();
}

double FollowedTarget::centring_sd_px() const {
  const double first_sd_px =
      kind_ == Kind::kDesignated ? config_.designation_sd_px : config_.acquisition_sd_px;
  if (!last_output_) return first_sd_px;
  return first_sd_px * size_px(last_output_->box) / first_size_px_;
}

}  // namespace ols::station
