// How a filter's state moves on: each model by itself, then mixed; the stations' biases by their
// prior.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "central/filter/track_filter.h"
#include "central/measurement/time_span.h"

namespace ols {

void TrackFilter::advance(std::int64_t utime_us, StationErrors& errors) {
  move_to(utime_us, errors);
  refresh();
}

void TrackFilter::move_to(std::int64_t utime_us, StationErrors& errors) {
  const double dt_s = seconds(utime_us - utime_us_);
  if (dt_s <= 0.0) return;
  for (std::size_t m = 0; m < models_.size(); ++m) {
    const Vector9 state = models_[m].mean.head<9>();
    propagate(transition(motions()[m], state, dt_s, config_.motion), models_[m]);
  }
  utime_us_ = utime_us;
  const double since_s = seconds(utime_us_ - mixed_us_);
  if (since_s < config_.mixing_s) return;
  mixed_us_ = utime_us_;
  refresh();
  move_biases(since_s, errors);
  mix(since_s);
}

void TrackFilter::mix(double dt_s) {
  const std::size_t models = models_.size();
  if (models == 1) return;
  std::array<MixtureWeights, kMotions> weights{};  // [to][from]
  for (std::size_t from = 0; from < models; ++from) {
    const double dwell_s = config_.motion.dwell_s[static_cast<std::size_t>(motions()[from])];
    const double stays = std::exp(-dt_s / dwell_s);
    for (std::size_t to = 0; to < models; ++to) {
      const double share = from == to ? stays : (1.0 - stays) / static_cast<double>(models - 1);
      weights[to][from] = share * probabilities_[from];
    }
  }
  for (std::size_t to = 0; to < models; ++to) {
    probabilities_[to] = std::accumulate(weights[to].begin(), weights[to].end(), 0.0);
    for (double& weight : weights[to]) weight /= probabilities_[to];
  }
  interact(weights, models_);
}

// Each station's bias is told to the errors' statistics, and moves on by its prior.
void TrackFilter::move_biases(double dt_s, StationErrors& errors) {
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    FilterStation& station = stations_[i];
    const int index = static_cast<int>(i);
    if (!priors_[i].place_apart && place_matters(station.sight)) tell_place_apart(index);
    const double range_m = (position() - station.sight.origin_ecef).norm();
    if (seconds(utime_us_ - station.utime_us) < 2.0 * config_.mixing_s + dt_s) {
      const StationBias now = bias(i);
      errors.observe(station.station, station.sight,
                     {now.bias_rad, now.covariance_rad2.diagonal(), now.prior_rad2.diagonal()},
                     dt_s, range_m);
    }
    priors_[i] = errors.prior(station.station, station.sight, range_m, priors_[i].place_apart);
  }
  fade_biases(dt_s, errors.clock_time_s());
}

// The station has states for its place from now on: a target that has come nearer.
void TrackFilter::tell_place_apart(int station) {
  BiasPrior& prior = priors_[static_cast<std::size_t>(station)];
  if (prior.place_apart) return;
  const Eigen::Index first = first_of(station) + kPoseStates;
  prior.place_apart = true;
  prior.place_m2 =
      stations_[static_cast<std::size_t>(station)].sight.origin_sd_enu_m.array().square();
  for (FilterGaussian& model : models_) {
    insert_states(first, kPlaceStates, model);
    model.covariance.diagonal().segment<kPlaceStates>(first) = prior.place_m2;
  }
}

// Each of the stations' states fades, and has as much added as its prior wants.
void TrackFilter::fade_biases(double dt_s, double clock_time_s) {
  const Eigen::Index n = models_[0].mean.size();
  FilterVector rate = FilterVector::Zero(n), variance = FilterVector::Zero(n);
  Eigen::Index at = 9;
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    const BiasPrior& prior = priors_[i];
    rate.segment<kPoseStates>(at) << prior.time_s.inverse(), 1.0 / clock_time_s;
    variance.segment<kPoseStates>(at) << prior.rotation, std::pow(stations_[i].clock_sd_s, 2);
    if (prior.place_apart) {
      rate.segment<kPlaceStates>(at + kPoseStates).setConstant(1.0 / prior.place_time_s);
      variance.segment<kPlaceStates>(at + kPoseStates) = prior.place_m2;
    }
    at += states_of(prior);
  }
  const FilterVector decay = (-dt_s * rate.array()).exp();
  const FilterVector added = (1.0 - decay.array().square()) * variance.array();
  for (FilterGaussian& model : models_) {
    scale(decay, model);
    model.covariance.diagonal() += added;
  }
}

}  // namespace ols
