#include "edge/calibration/drift_finding.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/angles.h"
#include "geometry/chi_square.h"

namespace ols::station {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Matrix23d = Eigen::Matrix<double, 2, 3>;

constexpr double kLevel = 1e-3;  // of the tests: a check that finds too much is repeated

// (left, up) of a direction by a turn about X, Y, Z of ORIGIN.
Matrix23d by_turn(const PanTilt& shafts) {
  const double c = std::cos(shafts.pan_rad), s = std::sin(shafts.pan_rad);
  const double ce = std::cos(shafts.tilt_rad), se = std::sin(shafts.tilt_rad);
  Matrix23d J;
  J << -se * c, -se * s, ce, s, -c, 0.0;
  return J;
}

Vector2d offset(const ViewOffset& view) { return {view.left_rad, view.up_rad}; }

bool acceptable(double chi_square, int freedom) {
  return freedom <= 0 || chi_square <= chi_square_critical(kLevel, freedom);
}

struct Turn {
  Vector3d by = Vector3d::Zero();
  Matrix3d covariance = Matrix3d::Zero();
  bool fits = false;
};

// Of the views but one.
Turn fit_turn(const std::vector<ViewOffset>& views, std::optional<std::size_t> without = {}) {
  Matrix3d information = Matrix3d::Zero();
  Vector3d right = Vector3d::Zero();
  double squares = 0.0;
  int equations = 0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (without == i) continue;
    const Matrix23d J = by_turn(views[i].shafts) / views[i].sd_rad;
    const Vector2d y = offset(views[i]) / views[i].sd_rad;
    information += J.transpose() * J;
    right += J.transpose() * y;
    squares += y.squaredNorm();
    equations += 2;
  }
  const Eigen::LDLT<Matrix3d> ldlt(information);
  Turn turn;
  turn.by = ldlt.solve(right);
  turn.covariance = ldlt.solve(Matrix3d::Identity());
  turn.fits = acceptable(squares - right.dot(turn.by), equations - 3);
  return turn;
}

// Of all views but one, if nothing has turned.
bool unmoved(const std::vector<ViewOffset>& views, std::optional<std::size_t> without = {}) {
  double squares = 0.0;
  int equations = 0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (without == i) continue;
    squares += (offset(views[i]) / views[i].sd_rad).squaredNorm();
    equations += 2;
  }
  return acceptable(squares, equations);
}

// Whole steps of one axis that explain all views; 0: they do not.
int lost_steps(const std::vector<ViewOffset>& views, bool pan, double step_rad) {
  const auto by_axis = [pan](const ViewOffset& view) {
    return pan ? Vector2d(std::cos(view.shafts.tilt_rad), 0.0) : Vector2d(0.0, 1.0);
  };
  double weight = 0.0, sum = 0.0;
  for (const ViewOffset& view : views) {
    const double w = 1.0 / (view.sd_rad * view.sd_rad);
    weight += w * by_axis(view).squaredNorm();
    sum += w * by_axis(view).dot(offset(view));
  }
  const int steps = static_cast<int>(std::lround(sum / weight / step_rad));
  std::vector<ViewOffset> rest = views;
  for (ViewOffset& view : rest) {
    const Vector2d left = offset(view) - steps * step_rad * by_axis(view);
    view.left_rad = left.x();
    view.up_rad = left.y();
  }
  return steps != 0 && unmoved(rest) ? steps : 0;
}

void set_turn(const Turn& turn, DriftFinding& finding) {
  finding.heading_rad = -turn.by.z();
  finding.heading_sd_rad = std::sqrt(turn.covariance(2, 2));
  finding.tilt_rad = turn.by.head<2>().norm();
  finding.tilt_sd_rad = std::sqrt(0.5 * turn.covariance.topLeftCorner<2, 2>().trace());
}

// At least what the steps amount to. The turn that fits best misses a lost tilt: a tripod that
// leans raises one view as far as it lowers the one opposite.
void cover_steps(double step_rad, DriftFinding& finding) {
  const double lost_rad = std::abs(finding.steps) * step_rad;
  if (!finding.pan) {
    finding.tilt_rad = std::max(finding.tilt_rad, lost_rad);
  } else if (std::abs(finding.heading_rad) < lost_rad) {
    finding.heading_rad = finding.steps > 0 ? -lost_rad : lost_rad;
  }
}

bool find_steps(const std::vector<ViewOffset>& views, const MotorSteps& steps,
                DriftFinding& finding) {
  for (const bool pan : {true, false}) {
    const double step_rad = pan ? steps.pan_rad : steps.tilt_rad;
    finding.steps = lost_steps(views, pan, step_rad);
    finding.pan = pan;
    if (finding.steps == 0) continue;
    cover_steps(step_rad, finding);
    return true;
  }
  return false;
}

// The view without which the others agree: with each other, and with the stored ones or on a turn.
std::optional<std::size_t> odd_view(const std::vector<ViewOffset>& views) {
  std::optional<std::size_t> odd;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (!unmoved(views, i)) continue;
    if (odd) return std::nullopt;
    odd = i;
  }
  return odd;
}

}  // namespace

MotorSteps motor_steps(const StationModel& model) {
  constexpr double kOfMotor_rad = radians(0.9);  // of a D46's
  return {kOfMotor_rad / model.pan.worm_teeth, kOfMotor_rad / model.tilt.worm_teeth};
}

DriftFinding find_drift(const std::vector<ViewOffset>& views, const MotorSteps& steps) {
  constexpr std::size_t kFewest = 3;
  DriftFinding finding;
  if (views.size() < kFewest) {
    finding.cause = DriftCause::kUnclear;
    return finding;
  }
  const Turn turn = fit_turn(views);
  set_turn(turn, finding);
  if (unmoved(views)) return finding;
  if (find_steps(views, steps, finding)) {
    finding.cause = DriftCause::kLostSteps;
  } else if (turn.fits) {
    finding.cause = DriftCause::kTripod;
  } else if (const auto odd = odd_view(views)) {
    finding.cause = DriftCause::kScene;
    finding.view = *odd;
    set_turn(fit_turn(views, odd), finding);
  } else {
    finding.cause = DriftCause::kUnclear;
  }
  return finding;
}

}  // namespace ols::station
