#include "central/filter/interacting_models.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "central/measurement/time_span.h"

namespace ols::fusion {
namespace {

constexpr double kLeastProbability = 1e-4;

}  // namespace

Eigen::Vector3d position_at(const KinematicState& state, std::int64_t utime_us) {
  const double dt_s = seconds(utime_us - state.utime_us);
  return state.mean.head<3>() + dt_s * state.mean.segment<3>(3) +
         dt_s * dt_s / 2.0 * state.mean.tail<3>();
}

InteractingModels::InteractingModels(const MotionConfig& config, std::int64_t utime_us,
                                     const FilterStart& start)
    : config_(config), utime_us_(utime_us) {
  if (config.models.empty() || config.models.size() > kMotions) {
    throw std::invalid_argument("a filter mixes one to three motion models");
  }
  models_.resize(config.models.size());
  probabilities_.assign(models_.size(), 1.0 / static_cast<double>(models_.size()));
  for (FilterGaussian& model : models_) {
    model.mean = FilterVector::Zero(9);
    model.mean.head<3>() = start.p_ecef;
    model.mean.segment<3>(3) = start.v_ecef;
    model.covariance = FilterMatrix::Zero(9, 9);
    Vector9 variance;
    variance.head<3>().setConstant(start.position_sd_m * start.position_sd_m);
    variance.segment<3>(3).setConstant(start.velocity_sd_m_s * start.velocity_sd_m_s);
    const double hard = manoeuvre_sd(Eigen::Vector3d::Zero(), config);
    variance.tail<3>().setConstant(hard * hard);
    model.covariance.diagonal() = variance;
  }
}

void InteractingModels::predict(std::int64_t utime_us) {
  const double dt_s = seconds(utime_us - utime_us_);
  for (std::size_t m = 0; m < models_.size(); ++m) {
    const Vector9 state = models_[m].mean.head<9>();
    propagate(transition(motion(m), state, dt_s, config_), models_[m]);
  }
  utime_us_ = utime_us;
}

void InteractingModels::interact(double dt_s) {
  const std::size_t models = models_.size();
  if (models == 1) return;
  std::array<MixtureWeights, kMotions> weights{};  // [to][from]
  for (std::size_t from = 0; from < models; ++from) {
    const double dwell_s = config_.dwell_s[static_cast<std::size_t>(motion(from))];
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
  ols::fusion::interact(weights, models_);
}

void InteractingModels::weigh(std::span<const double> log_likelihood) {
  const double most = *std::ranges::max_element(log_likelihood);
  double sum = 0.0;
  for (std::size_t m = 0; m < models_.size(); ++m) {
    probabilities_[m] *= std::exp(log_likelihood[m] - most);
    probabilities_[m] = std::max(probabilities_[m], kLeastProbability);
    sum += probabilities_[m];
  }
  for (double& probability : probabilities_) probability /= sum;
}

void InteractingModels::inflate(double time_s, const Eigen::Matrix3d& along,
                                const Eigen::Vector3d& v_ecef) {
  const double hard = manoeuvre_sd(v_ecef, config_);
  const double speed = 2.0 * hard * time_s;
  for (FilterGaussian& model : models_) {
    model.covariance.topLeftCorner<3, 3>() += std::pow(speed * time_s / 2.0, 2) * along;
    model.covariance.block<3, 3>(3, 3) += speed * speed * along;
    model.covariance.block<3, 3>(6, 6) += 4.0 * hard * hard * along;
  }
}

KinematicState InteractingModels::kinematics() const {
  const auto [mean, covariance] = target_mixture(models_, probabilities_);
  return {utime_us_, mean, covariance};
}

KinematicState InteractingModels::at(std::int64_t utime_us) const {
  const double dt_s = seconds(utime_us - utime_us_);
  std::array<TargetGaussian, kMotions> then;
  for (std::size_t m = 0; m < models_.size(); ++m) {
    then[m] = {models_[m].mean.head<9>(), models_[m].covariance.topLeftCorner<9, 9>()};
    const Vector9 now = then[m].mean;
    Transition t = transition(motion(m), now, std::abs(dt_s), config_);
    if (dt_s < 0.0) {  // the disturbance since then is in the state, and its bearings have shown it
      t.f << 1.0, dt_s, dt_s * dt_s / 2.0, 0.0, 1.0, dt_s, 0.0, 0.0, 1.0;
      t.q.setZero();
    }
    propagate(t, then[m]);
  }
  const std::span<const TargetGaussian> all = then;
  const auto [mean, covariance] = target_mixture(all.first(models_.size()), probabilities_);
  return {utime_us, mean, covariance};
}

FilterGaussian InteractingModels::mixed() const { return mixture(models_, probabilities_); }

}  // namespace ols::fusion
