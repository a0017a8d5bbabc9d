#include "edge/calibration/view_tour.h"

#include <algorithm>
#include <cmath>

#include "geometry/angles.h"

namespace ols::station {
namespace {

constexpr double kDegree = kPi / 180.0;
constexpr double kBeside_rad = 1.0 * kDegree;  // where a view is approached from: more than a slack
constexpr double kTilt_rad = 2.0 * kDegree;    // scenery at the horizon, and some sky
constexpr double kMargin_rad = 2.0 * kDegree;  // from the end of the travel
constexpr double kFree_s = 20.0;               // before a round that was asked for, or given up
constexpr double kReached_counts = 0.75;       // a whole count is commanded
constexpr double kGoal_s = 0.5;
constexpr int kViews = 4;
constexpr std::size_t kFewest = 3;

// Whole counts: the unit stands there exactly, whatever the way.
double whole(double angle_rad, double count_rad) {
  return count_rad > 0.0 ? std::round(angle_rad / count_rad) * count_rad : angle_rad;
}

}  // namespace

void ViewTour::plan(const mount::Limits& limits, const PanTilt& count) {
  count_ = count;
  views_.clear();
  left_out_.clear();
  const double low_rad = limits.pan_min_rad + kMargin_rad + kBeside_rad;
  const double span_rad = limits.pan_max_rad - kMargin_rad - low_rad;
  const double apart_rad = std::min(0.5 * kPi, span_rad / (kViews - 1));
  const double middle_rad = low_rad + 0.5 * span_rad;
  const double tilt_rad = std::clamp(kTilt_rad, limits.tilt_min_rad + kMargin_rad + kBeside_rad,
                                     limits.tilt_max_rad - kMargin_rad);
  for (int i = 0; i < kViews; ++i) {
    const PanTilt view{whole(middle_rad + (i - 0.5 * (kViews - 1)) * apart_rad, count.pan_rad),
                       whole(tilt_rad, count.tilt_rad)};
    PanTilt goal = view;
    if (reach(limits, view, goal) == mount::Reach::kUnreachable) continue;
    views_.push_back(view);
  }
}

void ViewTour::begin(double now_s) {
  view_ = 0;
  from_start_ = false;
  stands_since_s_.reset();
  leg_since_s_ = now_s;
  requested_ = false;
  leaving_out_.clear();
}

void ViewTour::give_up(double now_s) {
  if (view_) ended_s_ = now_s;
  view_.reset();
  stands_since_s_.reset();
}

bool ViewTour::take_finished() {
  const bool was = finished_;
  finished_ = false;
  return was;
}

PanTilt ViewTour::target() const {
  const PanTilt& view = views_[*view_];
  if (from_start_) return view;
  return {view.pan_rad - kBeside_rad, view.tilt_rad - kBeside_rad};
}

std::optional<mount::Goal> ViewTour::step(const Situation& situation) {
  const double now_s = situation.now_s;
  if (!situation.free || views_.size() < kFewest) {
    if (view_) requested_ = true;  // anew, when there is time again
    give_up(now_s);
    free_since_s_.reset();
    return std::nullopt;
  }
  if (!free_since_s_) free_since_s_ = now_s;
  if (!view_ && comes_back(now_s)) requested_ = true;
  if (!view_ && !is_due(now_s)) return std::nullopt;
  if (!view_) begin(now_s);
  while (view_ && config_.forbidden && config_.forbidden(views_[*view_])) {
    leaving_out_.push_back(*view_);
    go_on(now_s);
  }
  if (!view_) return std::nullopt;
  if (now_s - leg_since_s_ > config_.leg_s) {
    ++late_;
    give_up(now_s);
    return std::nullopt;
  }
  note_arrival(situation);
  return mount::Goal{now_s, target(), {}, now_s + kGoal_s};
}

bool ViewTour::is_due(double now_s) const {
  const double free_s = now_s - *free_since_s_;
  const double idle_s = std::min(free_s, now_s - ended_s_.value_or(*free_since_s_));
  return (requested_ && free_s >= kFree_s) || idle_s >= config_.interval_s;
}

// One that the last round left out may be looked at again. The sun is slow: asked now and then.
bool ViewTour::comes_back(double now_s) {
  constexpr double kAgain_s = 10.0;
  if (left_out_.empty() || now_s < looks_again_s_) return false;
  looks_again_s_ = now_s + kAgain_s;
  return std::ranges::any_of(left_out_,
                             [this](std::size_t view) { return !config_.forbidden(views_[view]); });
}

void ViewTour::note_arrival(const Situation& situation) {
  const PanTilt goal = target();
  const auto near = [](double a, double b, double count_rad) {
    constexpr double kUnknownCount_rad = 5e-5;
    return std::abs(a - b) < kReached_counts * (count_rad > 0.0 ? count_rad : kUnknownCount_rad);
  };
  const bool there = situation.at && near(situation.at->pan_rad, goal.pan_rad, count_.pan_rad) &&
                     near(situation.at->tilt_rad, goal.tilt_rad, count_.tilt_rad);
  if (!there) {
    stands_since_s_.reset();
  } else if (!from_start_) {
    from_start_ = true;
  } else if (!stands_since_s_) {
    stands_since_s_ = situation.now_s;
  }
}

std::optional<std::size_t> ViewTour::see(double mid_exposure_s) {
  if (!view_ || !stands_since_s_ || mid_exposure_s - *stands_since_s_ < config_.settle_s) {
    return std::nullopt;
  }
  const std::size_t seen = *view_;
  go_on(mid_exposure_s);
  return seen;
}

// To the next view; after the last one the round is over.
void ViewTour::go_on(double now_s) {
  from_start_ = false;
  stands_since_s_.reset();
  leg_since_s_ = now_s;
  if (++*view_ < views_.size()) return;
  view_.reset();
  finished_ = true;
  left_out_ = leaving_out_;
  late_ = 0;
  ended_s_ = now_s;
}

}  // namespace ols::station
