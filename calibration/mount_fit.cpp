#include "calibration/mount_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "geometry/median.h"

namespace ols::calibration {
namespace {

constexpr double kLeastSd_rad = 2e-5;  // of a position beside a picture
constexpr double kStray = 4.0;         // 1-sigmas
constexpr int kRounds = 20, kLeastRests = 5, kLeastMoves = 6;
// kLag: gain * delay plus half of the backlash over the speed.
enum Unknown { kZero, kGain, kBacklash, kMovingZero, kLag, kUnknowns };

using Vector = Eigen::Matrix<double, kUnknowns, 1>;
using Matrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;

struct Solution {
  Vector x = Vector::Zero();
  Matrix covariance = Matrix::Zero();
  double rest_sd_rad = 1e-3, move_sd_rad = 1e-2;
};

Vector row_of(const MountReading& r) {
  Vector row = Vector::Zero();
  row(kGain) = r.reported_rad;
  row(r.moves ? kMovingZero : kZero) = 1.0;
  if (r.moves)
    row(kLag) = r.rate_rad_s;
  else
    row(kBacklash) = 0.5 * r.approach;
  return row;
}

double residual(const MountReading& r, const Vector& x) { return r.seen_rad - row_of(r).dot(x); }

// Robust 1-sigma of the residuals of one kind.
double scatter(const std::vector<MountReading>& readings, const Vector& x, bool moves) {
  std::vector<double> sizes;
  for (const MountReading& r : readings) {
    if (r.moves == moves) sizes.push_back(std::abs(residual(r, x)));
  }
  if (sizes.empty()) return kLeastSd_rad;
  return std::max(1.4826 * median(std::move(sizes)), kLeastSd_rad);
}

// `robust`: by Huber's weights for the present solution.
void solve(const std::vector<MountReading>& readings, bool robust, Solution& s) {
  constexpr double kHuber = 1.5;  // 1-sigmas
  Matrix N = Matrix::Zero();
  Vector b = Vector::Zero();
  for (const MountReading& r : readings) {
    const double sd = r.moves ? s.move_sd_rad : s.rest_sd_rad;
    const double off = std::abs(residual(r, s.x)) / sd;
    const double weight = (robust && off > kHuber ? kHuber / off : 1.0) / (sd * sd);
    const Vector row = row_of(r);
    N += weight * row * row.transpose();
    b += weight * row * r.seen_rad;
  }
  s.covariance = N.completeOrthogonalDecomposition().pseudoInverse();
  s.x = N.completeOrthogonalDecomposition().solve(b);
}

// Also the deviations, from the residuals.
void settle(const std::vector<MountReading>& readings, Solution& s) {
  for (int round = 0; round < kRounds; ++round) {
    solve(readings, round > 0, s);
    s.rest_sd_rad = scatter(readings, s.x, false);
    s.move_sd_rad = scatter(readings, s.x, true);
  }
}

int count(const std::vector<MountReading>& readings, bool moves) {
  return static_cast<int>(std::ranges::count(readings, moves, &MountReading::moves));
}

Measured measured(const Solution& s, Unknown of) {
  return {s.x(of), std::sqrt(s.covariance(of, of))};
}

double speed(const std::vector<MountReading>& readings) {
  std::vector<double> speeds;
  for (const MountReading& r : readings) {
    if (r.moves) speeds.push_back(std::abs(r.rate_rad_s));
  }
  return median(std::move(speeds));
}

Measured delay(const Solution& s, double speed_rad_s) {
  Vector by = Vector::Zero();
  by(kLag) = 1.0;
  by(kBacklash) = -0.5 / speed_rad_s;
  by /= s.x(kGain);
  return {by.dot(s.x), std::sqrt(by.dot(s.covariance * by))};
}

// Both ways, or a delay is not told from the zero.
bool turned_both_ways(const std::vector<MountReading>& readings) {
  const auto turned = [&](double sign) {
    return std::ranges::any_of(
        readings, [&](const MountReading& r) { return r.moves && sign * r.rate_rad_s > 0.0; });
  };
  return turned(1.0) && turned(-1.0);
}

bool is_useful(const MountFit& fit) {
  constexpr double kGainShare = 0.02, kDelay_s = 0.1;
  return fit.gain.sd < kGainShare * std::abs(fit.gain.value) && fit.delay_s.sd < kDelay_s &&
         std::isfinite(fit.delay_s.value) && std::isfinite(fit.backlash_rad.value);
}

}  // namespace

std::optional<MountFit> fit_mount(std::vector<MountReading> readings) {
  constexpr double kTurns_rad_s = 2e-3;  // a slower one was taken before or after the motion
  std::erase_if(readings, [](const MountReading& r) {
    return r.moves && std::abs(r.rate_rad_s) < kTurns_rad_s;
  });
  if (!turned_both_ways(readings)) return std::nullopt;
  if (count(readings, false) < kLeastRests || count(readings, true) < kLeastMoves)
    return std::nullopt;
  const auto [least, most] = std::ranges::minmax(readings, {}, &MountReading::reported_rad);
  if (most.reported_rad - least.reported_rad < 1e-3) return std::nullopt;
  const auto from = [&](int side) {
    return std::ranges::any_of(readings,
                               [side](const auto& r) { return !r.moves && r.approach * side > 0; });
  };
  const bool both_sides = from(1) && from(-1);
  if (!both_sides) {
    for (MountReading& r : readings) r.approach = 0;
  }
  Solution s;
  settle(readings, s);
  std::erase_if(readings, [&](const MountReading& r) {
    return std::abs(residual(r, s.x)) > kStray * (r.moves ? s.move_sd_rad : s.rest_sd_rad);
  });
  settle(readings, s);
  solve(readings, false, s);
  MountFit fit;
  fit.rests = count(readings, false);
  fit.moves = count(readings, true);
  fit.gain = measured(s, kGain);
  if (fit.rests < kLeastRests || fit.moves < kLeastMoves || fit.gain.value == 0.0 ||
      !turned_both_ways(readings))
    return std::nullopt;
  fit.backlash_rad = measured(s, kBacklash);
  fit.delay_s = delay(s, speed(readings));
  fit.position_sd_rad = s.rest_sd_rad;
  return is_useful(fit) ? std::optional(fit) : std::nullopt;
}

bool have_different_delays(const MountFit& a, const MountFit& b) {
  constexpr double kSigmas = 3.0, kSame_s = 0.02;
  const double apart_s = std::abs(a.delay_s.value - b.delay_s.value);
  return apart_s > kSigmas * std::hypot(a.delay_s.sd, b.delay_s.sd) + kSame_s;
}

}  // namespace ols::calibration
