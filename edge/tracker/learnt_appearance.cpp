#include "edge/tracker/learnt_appearance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ols::tracker {
namespace {

constexpr double kUsualTime_s = 0.7;
constexpr double kLeastUsual = 1e-3;
// Of the colours' response, if they separate the target perfectly; the filter's has 1.
constexpr double kColourWeight = 0.6;

// 1 in the middle of the window, 0 at its edges, as the features of the filter are.
float fade(std::size_t i) {
  static const auto sines = [] {
    std::array<float, kMapSide> made;
    for (std::size_t k = 0; k < made.size(); ++k) {
      made[k] = static_cast<float>(
          std::pow(std::sin(std::numbers::pi * static_cast<double>(k) / kMapSide), 2));
    }
    return made;
  }();
  return sines[i / kMapSide] * sines[i % kMapSide];
}

}  // namespace

LearntAppearance::LearntAppearance(const TrackerInput& frame, const Eigen::Vector2d& pixel,
                                   const Eigen::Vector2d& size_px)
    : LearntAppearance(view_window(frame, window_around(pixel, size_px)), size_px) {}

LearntAppearance::LearntAppearance(const WindowView& view, const Eigen::Vector2d& size_px)
    : filter_(view, size_px),
      colours_(Palette::kColour, view, size_px),
      first_colours_(Palette::kHue, view, size_px),
      usual_(std::max(kLeastUsual, filter_.respond(view).peak().value)) {}

LearntAppearance::Searched LearntAppearance::search(const TrackerInput& frame,
                                                    const Eigen::Vector2d& pixel,
                                                    const Eigen::Vector2d& size_px) const {
  const WindowView view = view_window(frame, window_around(pixel, size_px));
  Searched made{filter_.respond(view),
                colours_.respond(view, size_px),
                {view.window, {}},
                first_colours_.respond(view, size_px),
                !view.bgr.empty()};
  const double known = made.in_colour ? colours_.separability() : 0.0;
  const auto weight = static_cast<float>(kColourWeight * known);
  const auto scale = static_cast<float>(1.0 / usual_);
  for (std::size_t i = 0; i < kMapArea; ++i) {
    made.filter.values[i] *= scale;
    made.both.values[i] =
        (made.filter.values[i] + weight * fade(i) * std::max(0.0F, made.colours.values[i])) /
        (1.0F + weight);
  }
  return made;
}

std::optional<Eigen::Vector2d> LearntAppearance::find(const TrackerInput& frame,
                                                      const std::vector<Eigen::Vector2d>& places,
                                                      const Eigen::Vector2d& size_px,
                                                      double least) {
  searched_.clear();
  Response::Peak best;
  for (const Eigen::Vector2d& place : places) {
    searched_.push_back(search(frame, place, size_px));
    const Response::Peak peak = searched_.back().both.peak();
    if (peak.value > best.value) best = peak;
  }
  if (best.value < least) return std::nullopt;
  return best.pixel;
}

void LearntAppearance::look_at(const TrackerInput& frame, const Eigen::Vector2d& pixel,
                               const Eigen::Vector2d& size_px) {
  constexpr double kInside = 0.125 * kMapSide;  // [cells] half a box
  for (const Searched& searched : searched_) {
    const FeatureWindow& window = searched.both.window;
    const Eigen::Vector2d off_px = pixel - window.pixel;
    if (off_px.cwiseAbs().maxCoeff() <= kInside * window.cell_px) return;
  }
  searched_.push_back(search(frame, pixel, size_px));
}

double LearntAppearance::recognised(const Eigen::Vector2d& pixel) const {
  const Searched* best = best_at(pixel);
  return best ? std::max(0.0, best->both.at(pixel)) : 0.0;
}

double LearntAppearance::prominence(const Eigen::Vector2d& pixel) const {
  const Searched* best = best_at(pixel);
  return best ? best->filter.prominence(pixel) : 0.0;
}

double LearntAppearance::first_colours(const Eigen::Vector2d& pixel) const {
  const Searched* best = best_at(pixel);
  return best ? best->first.contrast(pixel).above() : 0.0;
}

double LearntAppearance::first_separability(const Eigen::Vector2d& pixel) const {
  const Searched* best = best_at(pixel);
  return best && best->in_colour ? first_colours_.separability() : 0.0;
}

// 1 where nothing is known.
double LearntAppearance::colour(const Eigen::Vector2d& pixel) const {
  const Searched* best = best_at(pixel);
  const bool is_known = best && best->in_colour && colours_.separability() > 0.0;
  return is_known ? best->colours.at(pixel) : 1.0;
}

const LearntAppearance::Searched* LearntAppearance::best_at(const Eigen::Vector2d& pixel) const {
  const auto best = std::max_element(
      searched_.begin(), searched_.end(),
      [&](const Searched& a, const Searched& b) { return a.both.at(pixel) < b.both.at(pixel); });
  return best == searched_.end() ? nullptr : &*best;
}

void LearntAppearance::learn(const TrackerInput& frame, const Eigen::Vector2d& pixel,
                             const Eigen::Vector2d& size_px, double interval_s) {
  constexpr double kLeastShare = 0.1;
  constexpr double kColourTime_s = 0.8, kFirst_s = 0.5;
  const double wrong = 1.0 - std::clamp(colour(pixel), 0.0, 1.0);
  const double trust = std::max(kLeastShare, 1.0 - colours_.separability() * wrong);
  const double share = 1.0 - std::exp(-interval_s / kUsualTime_s);
  usual_ = std::max(kLeastUsual, usual_ * (1.0 + share * (recognised(pixel) - 1.0)));
  const WindowView view = view_window(frame, window_around(pixel, size_px));
  filter_.learn(view, trust);
  colours_.learn(view, size_px, trust * (1.0 - std::exp(-interval_s / kColourTime_s)));
  if (first_s_ >= kFirst_s) return;
  first_s_ += interval_s;
  first_colours_.learn(view, size_px, interval_s / (first_s_ + interval_s));
}

}  // namespace ols::tracker
