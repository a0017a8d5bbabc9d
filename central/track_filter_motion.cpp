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
    const Transition t =
        transition(static_cast<Motion>(m), model.mean.head<9>(), dt_s, config_.motion);
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

void TrackFilter::mix(double dt_s) {
  std::array<std::array<double, kMotions>, kMotions> weight{};  // [to][from]
  for (std::size_t from = 0; from < kMotions; ++from) {
    const double stays = std::exp(-dt_s / config_.motion.dwell_s[from]);
    for (std::size_t to = 0; to < kMotions; ++to) {
      const double share = from == to ? stays : (1.0 - stays) / (kMotions - 1);
      weight[to][from] = share * models_[from].probability;
    }
  }
  const std::array<Model, kMotions> was = models_;
  for (std::size_t to = 0; to < kMotions; ++to) {
    double sum = 0.0;
    for (const double w : weight[to]) sum += w;
    Model& model = models_[to];
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
    // Rounding makes the two triangles differ, and what differs grows: by the minute, tenfold.
    model.covariance = (0.5 * (model.covariance + model.covariance.transpose())).eval();
  }
}

// Each station's bias is told to the errors' statistics, and moves on by its prior.
void TrackFilter::move_biases(double dt_s, StationErrors& errors) {
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    FilterStation& station = stations_[i];
    const int index = static_cast<int>(i);
    if (place_matters(station.sight)) tell_place_apart(index);
    const double range_m = (position() - station.sight.origin_ecef).norm();
    if (seconds(utime_us_ - station.utime_us) < 2.0 * config_.mixing_s + dt_s) {
      const StationBias now = bias(i);
      errors.observe(station.station, station.sight,
                     {now.bias_rad, now.covariance_rad2.diagonal(), now.prior_rad2.diagonal()},
                     dt_s, range_m);
    }
    priors_[i] = errors.prior(station.station, station.sight, range_m, priors_[i].place_apart);
    move_bias(index, dt_s, errors.clock_time_s());
  }
}

// The station has states for its place from now on: a target that has come nearer.
void TrackFilter::tell_place_apart(int station) {
  BiasPrior& prior = priors_[static_cast<std::size_t>(station)];
  if (prior.place_apart) return;
  const Eigen::Index first = first_of(station) + kPoseStates, n = models_[0].mean.size();
  const Eigen::Index rest = n - first, then = first + kPlaceStates;
  prior.place_apart = true;
  prior.place_m2 =
      stations_[static_cast<std::size_t>(station)].sight.origin_sd_enu_m.array().square();
  for (Model& model : models_) {
    const Model was = model;
    model.mean = FilterVector::Zero(n + kPlaceStates);
    model.mean.head(first) = was.mean.head(first);
    model.mean.tail(rest) = was.mean.tail(rest);
    model.covariance = FilterMatrix::Zero(n + kPlaceStates, n + kPlaceStates);
    model.covariance.topLeftCorner(first, first) = was.covariance.topLeftCorner(first, first);
    model.covariance.block(0, then, first, rest) = was.covariance.topRightCorner(first, rest);
    model.covariance.block(then, 0, rest, first) = was.covariance.bottomLeftCorner(rest, first);
    model.covariance.bottomRightCorner(rest, rest) = was.covariance.bottomRightCorner(rest, rest);
    model.covariance.diagonal().segment<kPlaceStates>(first) = prior.place_m2;
  }
}

// Each of a station's states fades, and has as much added as its prior wants.
void TrackFilter::move_bias(int station, double dt_s, double clock_time_s) {
  const BiasPrior& prior = priors_[static_cast<std::size_t>(station)];
  const double clock_sd_s = stations_[static_cast<std::size_t>(station)].clock_sd_s;
  const Eigen::Index at = first_of(station), n = states_of(prior);
  StationVector time_s(n), variance(n);
  time_s.head<kPoseStates>() << prior.time_s, clock_time_s;
  variance.head<kPoseStates>() << prior.rotation, clock_sd_s * clock_sd_s;
  if (prior.place_apart) {
    time_s.tail<kPlaceStates>().setConstant(prior.place_time_s);
    variance.tail<kPlaceStates>() = prior.place_m2;
  }
  const StationVector decay = (-dt_s / time_s.array()).exp();
  for (Model& model : models_) {
    model.mean.segment(at, n).array() *= decay.array();
    model.covariance.middleRows(at, n).array().colwise() *= decay.array();
    model.covariance.middleCols(at, n).array().rowwise() *= decay.transpose().array();
    model.covariance.diagonal().segment(at, n).array() +=
        (1.0 - decay.array().square()) * variance.array();
  }
}

}  // namespace ols
