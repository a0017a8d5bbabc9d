#include "dev/estimators/recorded.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "central/offline/offline_fusion.h"
#include "dev/bench/load.h"

namespace ols::bench {
namespace {

struct Error {
  double size_m = 0.0, nees = 0.0;  // nees: of an axis
};
using Errors = std::map<std::int64_t, Error>;  // by instant

Errors errors_of(const Recording& recording, const char* estimator, bool smooth) {
  fusion::OfflineConfig config;
  config.estimator = estimator;
  config.smooth = smooth;
  config.rate_hz = recording.rate_hz;
  config.fusion.tracks.errors.clock_weight = 1.0;
  Errors errors;
  for (const fusion::FusedTarget& target : fusion::fuse_offline(recording.bearings, config)) {
    const double time_s = static_cast<double>(target.utime_us - kStartUs) * 1e-6;
    if (time_s < recording.from_s || time_s > recording.until_s) continue;
    const Eigen::Vector3d off =
        target.estimate.position_ecef - site().to_ecef(at(recording.path, time_s).p_enu);
    const Eigen::Matrix3d R = R_ecef_enu(target.estimate.position_ecef);
    const Eigen::Array3d variance =
        (R.transpose() * target.estimate.covariance_ecef * R).diagonal();
    const Eigen::Array3d off_enu = R.transpose() * off;
    errors[target.utime_us] = {off.norm(), (off_enu.square() / variance).mean()};
  }
  return errors;
}

// Of one recording: median, RMS and 95 % of the error, and the normalised error squared of an axis.
struct Score {
  std::array<double, 3> size_m{};
  double nees = 0.0;
};

Score score_of(const Errors& errors, const std::vector<std::int64_t>& instants) {
  std::vector<double> sizes;
  Score score;
  double squared = 0.0;
  const auto n = static_cast<double>(instants.size());
  for (const std::int64_t instant : instants) {
    const Error& error = errors.at(instant);
    sizes.push_back(error.size_m);
    squared += error.size_m * error.size_m / n;
    score.nees += error.nees / n;
  }
  score.size_m = {quantile(sizes, 0.5), std::sqrt(squared), quantile(sizes, 0.95)};
  return score;
}

}  // namespace

void AgainstLeastSquares::add(const Recording& recording) {
  constexpr std::size_t kLeastInstants = 10;
  const Errors reference = errors_of(recording, "least-squares", false);
  const Errors own = errors_of(recording, "filter", smooth_);
  std::vector<std::int64_t> instants;
  for (const auto& [instant, error] : reference) {
    if (own.contains(instant)) instants.push_back(instant);
  }
  if (instants.size() < kLeastInstants) return;
  const Score ours = score_of(own, instants), theirs = score_of(reference, instants);
  for (std::size_t i = 0; i < log_ratio_.size(); ++i) {
    log_ratio_[i].push_back(std::log(ours.size_m[i] / theirs.size_m[i]));
  }
  nees_.push_back(ours.nees);
}

double AgainstLeastSquares::ratio(std::size_t i) const {
  double sum = 0.0;
  for (const double value : log_ratio_[i]) sum += value;
  return std::exp(sum / static_cast<double>(log_ratio_[i].size()));
}

double AgainstLeastSquares::worse_percent(std::size_t i) const {
  const auto count = std::ranges::count_if(log_ratio_[i], [](double x) { return x > 0.02; });
  return 100.0 * static_cast<double>(count) / static_cast<double>(log_ratio_[i].size());
}

void AgainstLeastSquares::print() const {
  std::printf(
      "  %s over least squares, %zu recordings: median %.3f, RMS %.3f, p95 %.3f (worse in "
      "%.0f, %.0f, %.0f %%); NEES of an axis 10 %% %.2f, median %.2f, 90 %% %.2f\n",
      name_.c_str(), nees_.size(), ratio(0), ratio(1), ratio(2), worse_percent(0), worse_percent(1),
      worse_percent(2), quantile(nees_, 0.1), quantile(nees_, 0.5), quantile(nees_, 0.9));
}

void AgainstLeastSquares::judge(Limits& limits, double least_nees) const {
  print();
  const char* const sizes[] = {"median", "RMS", "95 %"};
  for (std::size_t i = 0; i < std::size(sizes); ++i) {
    limits.at_most(std::string(sizes[i]) + " over that of least squares", ratio(i), 1.02);
  }
  limits.within("normalised error squared of an axis", quantile(nees_, 0.5), least_nees, 2.5);
}

}  // namespace ols::bench
