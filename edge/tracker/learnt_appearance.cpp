#include "edge/tracker/learnt_appearance.h"

#include <algorithm>
#include <cmath>

namespace ols::tracker {
namespace {

constexpr double kUsualTime_s = 0.7;
constexpr double kLeastUsual = 1e-3;

}  // namespace

LearntAppearance::LearntAppearance(const TrackerInput& frame, const Eigen::Vector2d& pixel,
                                   const Eigen::Vector2d& size_px)
    : filter_(frame, pixel, size_px),
      usual_(std::max(kLeastUsual, filter_.respond(frame, pixel, size_px).peak().value)) {}

std::optional<Eigen::Vector2d> LearntAppearance::find(const TrackerInput& frame,
                                                      const std::vector<Eigen::Vector2d>& places,
                                                      const Eigen::Vector2d& size_px,
                                                      double least) {
  responses_.clear();
  Response::Peak best;
  for (const Eigen::Vector2d& place : places) {
    responses_.push_back(filter_.respond(frame, place, size_px));
    const Response::Peak peak = responses_.back().peak();
    if (peak.value > best.value) best = peak;
  }
  if (best.value < least * usual_) return std::nullopt;
  return best.pixel;
}

void LearntAppearance::look_at(const TrackerInput& frame, const Eigen::Vector2d& pixel,
                               const Eigen::Vector2d& size_px) {
  constexpr double kInside = 0.125 * kMapSide;  // [cells] half a box
  for (const Response& response : responses_) {
    const Eigen::Vector2d off_px = pixel - response.window.pixel;
    if (off_px.cwiseAbs().maxCoeff() <= kInside * response.window.cell_px) return;
  }
  responses_.push_back(filter_.respond(frame, pixel, size_px));
}

double LearntAppearance::recognised(const Eigen::Vector2d& pixel) const {
  double most = 0.0;
  for (const Response& response : responses_) most = std::max(most, response.at(pixel));
  return most / usual_;
}

double LearntAppearance::prominence(const Eigen::Vector2d& pixel) const {
  const Response* best = nullptr;
  for (const Response& response : responses_) {
    if (!best || response.at(pixel) > best->at(pixel)) best = &response;
  }
  return best ? best->prominence(pixel) : 0.0;
}

void LearntAppearance::learn(const TrackerInput& frame, const Eigen::Vector2d& pixel,
                             const Eigen::Vector2d& size_px, double interval_s) {
  const double share = 1.0 - std::exp(-interval_s / kUsualTime_s);
  usual_ = std::max(kLeastUsual, usual_ * (1.0 + share * (recognised(pixel) - 1.0)));
  filter_.learn(frame, pixel, size_px);
}

}  // namespace ols::tracker
