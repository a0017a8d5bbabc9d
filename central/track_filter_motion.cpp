// How a filter's state moves on: each model by itself, then mixed; the stations' biases by their
// prior.
#include <algorithm>
#include <cmath>

#include "central/time_span.h"
#include "central/track_filter.h"

namespace ols {

void TrackFilter::advance(std::int64_t utime_us, StationErrors& errors) {
  move_to(utime_us, errors);
  refresh();
}

void TrackFilter::move_to(std::int64_t utime_us, StationErrors& errors) {
  const double dt_s = seconds(utime_us - utime_us_);
  if (dt_s <= 0.0) return;
  for (std::size_t m = 0; m < models_.size(); ++m) {
    Model& model = models_[m];
    const Transition t = transition(motion_of(m), model.mean.head<9>(), dt_s, config_.motion);
    transform_rows(t.f, model.mean);
    propagate_covariance(t, model.covariance);
  }
  utime_us_ = utime_us;
  const double since_s = seconds(utime_us_ - mixed_us_);
  if (since_s < config_.mixing_s) return;
  mixed_us_ = utime_us_;
  refresh();
  move_biases(since_s, errors);
  mix(since_s);
}

// A station that states an error is the first reason for more than one supposition.
void TrackFilter::suppose(const BiasPrior& prior) {
  if (models_.size() == kModels || (prior.time_s.front() == prior.time_s.back()).all()) return;
  for (Model& model : models_) model.probability /= kSuppositions;
  const std::vector<Model> own = models_;
  while (models_.size() < kModels) models_.insert(models_.end(), own.begin(), own.end());
}

void TrackFilter::mix(double dt_s) {
  for (std::size_t first = 0; first < models_.size(); first += kMotions) {
    mix_motions(std::span(models_).subspan(first).first<kMotions>(), dt_s);
  }
}

void TrackFilter::mix_motions(std::span<Model, kMotions> models, double dt_s) const {
  std::array<std::array<double, kMotions>, kMotions> weight{};  // [to][from]
  for (std::size_t from = 0; from < kMotions; ++from) {
    const double stays = std::exp(-dt_s / config_.motion.dwell_s[from]);
    for (std::size_t to = 0; to < kMotions; ++to) {
      const double share = from == to ? stays : (1.0 - stays) / (kMotions - 1);
      weight[to][from] = share * models[from].probability;
    }
  }
  std::array<Model, kMotions> was;
  std::ranges::copy(models, was.begin());
  for (std::size_t to = 0; to < kMotions; ++to) {
    double sum = 0.0;
    for (const double w : weight[to]) sum += w;
    Model& model = models[to];
    model.probability = sum;
    model.mean.setZero();
    model.covariance.setZero();
    for (std::size_t from = 0; from < kMotions; ++from) {
      model.mean += weight[to][from] / sum * was[from].mean;
    }
    for (std::size_t from = 0; from < kMotions; ++from) {
      const double w = weight[to][from] / sum;
      const FilterVector off = was[from].mean - model.mean;
      model.covariance += w * was[from].covariance;
      model.covariance.noalias() += (w * off) * off.transpose();
    }
  }
}

// A wrong pose shows as another bias in another direction: a rotation by an angle leaves its
// cosine. Counted every half radian, so that it adds up over a circle and not over every small
// movement.
double TrackFilter::turned(FilterStation& station) {
  constexpr double kSameRad = 0.5;
  const Eigen::Vector3d now =
      station.R_ecef_enu * enu_from_azimuth_elevation(station.sight.direction);
  const double cosine = now.dot(station.aimed);
  if (cosine > std::cos(kSameRad)) return 1.0;
  station.aimed = now;
  return std::max(0.0, cosine);
}

// Each station's bias is told to the errors' statistics, and moves on by its prior.
void TrackFilter::move_biases(double dt_s, StationErrors& errors) {
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    FilterStation& station = stations_[i];
    const double range_m = (position() - station.sight.origin_ecef).norm();
    if (seconds(utime_us_ - station.utime_us) < 2.0 * config_.mixing_s + dt_s) {
      const StationBias now = bias(i);
      errors.observe(station.station, station.sight,
                     {now.bias_rad, now.covariance_rad2.diagonal(), now.prior_rad2.diagonal()},
                     dt_s, range_m);
    }
    priors_[i] = errors.prior(station.station, station.sight, range_m);
    const double turn = turned(station);
    const double clock = std::exp(-dt_s / errors.clock_time_s());
    const auto at = static_cast<Eigen::Index>(9 + 3 * i);
    for (std::size_t m = 0; m < models_.size(); ++m) {
      Model& model = models_[m];
      const Eigen::Array2d decay = turn * (-dt_s / priors_[i].time_s[m / kMotions]).exp();
      model.mean.segment<2>(at).array() *= decay;
      model.covariance.middleRows<2>(at).array().colwise() *= decay;
      model.covariance.middleCols<2>(at).array().rowwise() *= decay.transpose();
      const Eigen::Vector2d fresh = (1.0 - decay.square()).sqrt();
      model.covariance.block<2, 2>(at, at) +=
          fresh.asDiagonal() * priors_[i].covariance * fresh.asDiagonal();
      model.mean(at + 2) *= clock;
      model.covariance.row(at + 2) *= clock;
      model.covariance.col(at + 2) *= clock;
      model.covariance(at + 2, at + 2) += (1.0 - clock * clock) * std::pow(station.clock_sd_s, 2);
    }
  }
}

}  // namespace ols
