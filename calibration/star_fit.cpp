#include "calibration/star_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "geometry/angles.h"

namespace ols::calibration {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double kAnyHeading_rad = 1.0;
constexpr double kAnyFocal = 0.01;  // of the focal length
// The next gates of a fit [px]: what the one before leaves; the last follows from the deviations.
constexpr double kGates_px[] = {60.0, 40.0, 15.0, 6.0};
constexpr double kGateSigmas = 5.0;

// No corner is further from the middle of the picture.
double field_radius_rad(const CameraIntrinsics& camera) {
  return 0.5 * field_of_view(camera).norm();
}

}  // namespace

StarFit::StarFit(const StationPrior& station, const std::vector<SeenFrame>& frames, double sd_px)
    : station_(station),
      frames_(frames),
      sd_px_(sd_px),
      prior_(station.covariance.topLeftCorner<kModelParameters, kModelParameters>()) {
  prior_.row(kHeading).setZero();
  prior_.col(kHeading).setZero();
  prior_(kHeading, kHeading) = kAnyHeading_rad * kAnyHeading_rad;
}

StationModel StarFit::at(const ModelParameters& change) const {
  return changed(station_.model, change);
}

// In the space of the observations, so that a parameter without a deviation needs no inverse:
// x = C J' (J C J' + R)^-1 (v + J x).
StarFit::Solution StarFit::solve(const std::vector<StarPair>& pairs, const ModelParameters& from,
                                 double sd_px, const Prior& prior) const {
  const StationModel model = at(from);
  MatrixXd J(2 * static_cast<Index>(pairs.size()), static_cast<Index>(kModelParameters));
  // The errors of a pose's two angles are the same for all stars of its frame.
  MatrixXd by_poses = MatrixXd::Zero(J.rows(), 2 * static_cast<Index>(frames_.size()));
  VectorXd v(J.rows());
  Index rows = 0;
  for (const StarPair& pair : pairs) {
    const SeenFrame& frame = frames_[pair.frame];
    const auto image = predict_pixel(model, frame.reading, {frame.sky[pair.star].enu, 0.0});
    if (!image) continue;
    J.middleRows<2>(rows) = image->by_parameters;
    by_poses.block<2, 2>(rows, 2 * static_cast<Index>(pair.frame)) =
        station_.pose_sd_rad * image->by_shafts;
    v.segment<2>(rows) = frame.detections[pair.seen].pixel - image->pixel;
    rows += 2;
  }
  Solution result;
  result.change = from;
  result.focal_variance = prior(kFocal, kFocal);
  if (rows == 0) return result;
  const MatrixXd Ju = J.topRows(rows);
  const MatrixXd Pu = by_poses.topRows(rows);
  const MatrixXd CJ = prior * Ju.transpose();
  MatrixXd S = Ju * CJ + Pu * Pu.transpose();
  S.diagonal().array() += sd_px * sd_px;
  const auto solver = S.ldlt();
  result.change = CJ * solver.solve(v.head(rows) + Ju * from);
  const VectorXd left = v.head(rows) - Ju * (result.change - from);
  result.rms_px = std::sqrt(left.squaredNorm() / static_cast<double>(rows));
  result.focal_variance -= CJ.row(kFocal).dot(solver.solve(CJ.row(kFocal).transpose()));
  return result;
}

std::vector<std::pair<std::size_t, Vector2d>> StarFit::in_image(const StationModel& model,
                                                                const SeenFrame& frame,
                                                                double edge_px) const {
  const CameraIntrinsics& camera = model.geometry.camera;
  const Vector2d most(camera.width_px - 1.0, camera.height_px - 1.0);
  const double within =
      std::cos(std::min(kPi, field_radius_rad(camera) + 2.0 * edge_px / camera.fx_px));
  const auto axis = predict_direction(model, frame.reading, 0.5 * most);
  std::vector<std::pair<std::size_t, Vector2d>> result;
  if (!axis) return result;
  const Eigen::Vector3d ahead = enu_from_azimuth_elevation(axis->direction);
  for (std::size_t j = 0; j < frame.sky.size(); ++j) {
    if (frame.sky[j].enu.dot(ahead) < within) continue;
    const auto image = predict_pixel(model, frame.reading, {frame.sky[j].enu, 0.0});
    if (!image || (image->pixel.array() < -edge_px).any() ||
        ((image->pixel - most).array() > edge_px).any()) {
      continue;
    }
    result.emplace_back(j, image->pixel);
  }
  return result;
}

// The nearest first; each detection and each star once.
std::vector<StarPair> StarFit::matched(const StationModel& model, double gate_px) const {
  std::vector<StarPair> result;
  for (std::size_t f = 0; f < frames_.size(); ++f) {
    const SeenFrame& frame = frames_[f];
    std::vector<std::tuple<double, std::size_t, std::size_t>> near;
    for (const auto& [j, pixel] : in_image(model, frame, gate_px)) {
      for (std::size_t i = 0; i < frame.detections.size(); ++i) {
        const double distance_px = (frame.detections[i].pixel - pixel).norm();
        if (distance_px < gate_px) near.emplace_back(distance_px, i, j);
      }
    }
    std::ranges::sort(near);
    std::vector<bool> seen(frame.detections.size()), taken(frame.sky.size());
    for (const auto& [distance_px, i, j] : near) {
      if (seen[i] || taken[j]) continue;
      seen[i] = taken[j] = true;
      result.push_back({f, i, j});
    }
  }
  return result;
}

StarFit::Result StarFit::refined(const StarHypothesis& hypothesis) const {
  ModelParameters change = ModelParameters::Zero();
  change[kHeading] = wrap_pi(hypothesis.heading_rad - station_.model.geometry.chain.heading_rad);
  std::vector<StarPair> pairs = hypothesis.pairs;
  for (const double gate_px : kGates_px) {
    // Twice: the first step is a long one.
    for (int i = 0; i < 2; ++i) change = solve(pairs, change, gate_px / 3.0, prior_).change;
    pairs = matched(at(change), gate_px);
  }
  const double with_pose_px =
      std::hypot(sd_px_, station_.pose_sd_rad * station_.model.geometry.camera.fx_px);
  Solution solution;
  for (int i = 0; i < 3; ++i) {
    solution = solve(pairs, change, sd_px_, prior_);
    change = solution.change;
    pairs = matched(at(change), kGateSigmas * with_pose_px);
  }
  Result result;
  result.heading_rad = at(change).geometry.chain.heading_rad;
  result.rms_px = solution.rms_px;
  for (const SeenFrame& frame : frames_) {
    result.possible += std::min(frame.detections.size(), in_image(at(change), frame, 0.0).size());
  }
  result.pairs = std::move(pairs);
  // The focal length by the stars: its prior is opened.
  const double focal_px = station_.model.geometry.camera.fx_px;
  Prior open = prior_;
  open.row(kFocal).setZero();
  open.col(kFocal).setZero();
  open(kFocal, kFocal) = std::pow(kAnyFocal * focal_px, 2);
  const Solution by_stars = solve(result.pairs, change, sd_px_, open);
  result.focal_change = by_stars.change[kFocal] / focal_px;
  result.focal_sd = std::sqrt(std::max(0.0, by_stars.focal_variance)) / focal_px;
  return result;
}

}  // namespace ols::calibration
