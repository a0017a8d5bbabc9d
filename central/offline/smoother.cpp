#include "central/offline/smoother.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace ols::fusion {
namespace {

// The whole state of a filter at an instant, its stations in a fixed order.
struct Whole {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

// Added so that it can be inverted: 10 ns, 10 nrad, 10 nm.
constexpr double kLeast = 1e-16;

using Order = std::map<std::string, Eigen::Index>;  // station -> first of its states

// The state extended to all stations' states; those that it does not hold get their prior.
Whole spread(const TrackFilter& filter, const Order& order, const Eigen::VectorXd& prior,
             double clock_sign) {
  const auto [mean, covariance] = filter.mixed();
  std::vector<Eigen::Index> to(static_cast<std::size_t>(mean.size()));
  std::vector<double> sign(to.size(), 1.0);
  for (std::size_t i = 0; i < 9; ++i) to[i] = static_cast<Eigen::Index>(i);
  for (std::size_t i = 3; i < 6; ++i) sign[i] = clock_sign;  // velocities turn with time
  std::size_t k = 9;
  for (std::size_t i = 0; i < filter.stations().size(); ++i) {
    const Eigen::Index first = order.at(filter.stations()[i].station);
    sign[k + 3] = clock_sign;
    for (Eigen::Index axis = 0; axis < states_of(filter.priors()[i]); ++axis)
      to[k++] = first + axis;
  }
  Whole whole{Eigen::VectorXd::Zero(prior.size()), prior.asDiagonal()};
  for (std::size_t i = 0; i < to.size(); ++i) {
    const auto from = static_cast<Eigen::Index>(i);
    whole.mean(to[i]) = sign[i] * mean(from);
    for (std::size_t j = 0; j < to.size(); ++j) {
      whole.covariance(to[i], to[j]) =
          sign[i] * sign[j] * covariance(from, static_cast<Eigen::Index>(j));
    }
  }
  auto stations = whole.covariance.diagonal().tail(prior.size() - 9);
  stations = stations.cwiseMax(kLeast).eval();
  return whole;
}

// The models expect no acceleration, in both runs: the prior is taken from one run only, or it
// would count twice.
void forget_acceleration(Whole& whole) {
  constexpr double kUnknown = 1e12;
  whole.mean.segment<3>(6).setZero();
  whole.covariance.middleRows<3>(6).setZero();
  whole.covariance.middleCols<3>(6).setZero();
  whole.covariance.diagonal().segment<3>(6).setConstant(kUnknown);
}

// The sum of both informations, minus that of the prior that both contain.
std::optional<Whole> join(const Whole& a, const Whole& b, const Eigen::VectorXd& prior) {
  const Eigen::LDLT<Eigen::MatrixXd> Pa(a.covariance), Pb(b.covariance);
  const auto n = prior.size();
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(n, n);
  Eigen::MatrixXd information = Pa.solve(one) + Pb.solve(one);
  information.diagonal().tail(n - 9) -= prior.tail(n - 9).cwiseInverse();
  const Eigen::LDLT<Eigen::MatrixXd> joint(information);
  if (joint.info() != Eigen::Success || !joint.isPositive()) return std::nullopt;
  // Relative to the first mean: coordinates of millions of metres would cost digits.
  return Whole{a.mean + joint.solve(Pb.solve(b.mean - a.mean)), joint.solve(one)};
}

// What is needed of a run at an instant.
struct Passed {
  std::optional<TrackFilter> filter;  // nothing: no position
  bool is_initiated = false;

  explicit Passed(const RecordedTrack& track) : is_initiated(track.is_initiated()) {
    if (const Track* const located = track.located()) filter = located->filter;
  }
};

// A track that still rests on two rays, one of which may be wrong, is not joined: it is used alone,
// and only if the other is no better.
void leave_worth_joining(Passed& past, Passed& future) {
  if (!past.filter || !future.filter) return;
  if (!future.is_initiated) {
    future.filter.reset();
  } else if (!past.is_initiated) {
    past.filter.reset();
  }
}

// The systematic part of the covariance is taken from the better of the two filters: how fast
// biases change is the least known of all, and a bias that is constant over some seconds is the
// same before and after.
SystematicPart told_biases(const std::optional<TrackFilter>& from_past,
                           const std::optional<TrackFilter>& from_future) {
  if (!from_past) return from_future->systematic();
  const SystematicPart before = from_past->systematic();
  if (!from_future) return before;
  const SystematicPart after = from_future->systematic();
  return after.all_m2.trace() < before.all_m2.trace() ? after : before;
}

// Processes the bearings up to an instant, forwards, or backwards in mirrored time.
struct Runner {
  RecordedTrack track;
  const BearingPointers* bearings;
  const std::set<std::string>* beside;
  const std::function<void()>* tell;
  std::optional<std::int64_t> mirrored_about_us{};
  std::size_t next = 0;

  void run(std::int64_t utime_us, bool inclusive) {
    for (; next < bearings->size(); ++next) {
      if (!mirrored_about_us) {
        if (!take(*(*bearings)[next], utime_us, inclusive)) break;
        continue;
      }
      BearingMeasurement measurement = *(*bearings)[bearings->size() - 1 - next];
      measurement.utime_us = *mirrored_about_us - measurement.utime_us;
      if (!take(measurement, utime_us, inclusive)) break;
    }
  }

 private:
  bool take(const BearingMeasurement& measurement, std::int64_t utime_us, bool inclusive) {
    if (measurement.utime_us > utime_us || (measurement.utime_us == utime_us && !inclusive))
      return false;
    if (*tell) (*tell)();
    track.advance(measurement.utime_us);
    track.add(measurement, !beside->contains(measurement.station));
    return true;
  }
};

class Smoother {
 public:
  Smoother(const BearingPointers& bearings, const TrackManagerConfig& config,
           const KnownStations& known, const SmootherOutput& output)
      : bearings_(bearings),
        about_us_(bearings.front()->utime_us + bearings.back()->utime_us),
        output_(output),
        beside_(known.beside),
        learnt_(same_states(config)) {
    learnt_.set_errors(known.errors);
    for (const std::string& station : beside_) learnt_.forget_station(station);
    for (const BearingMeasurement* measurement : bearings) {
      if (order_
              .try_emplace(measurement->station,
                           9 + kStationStates * static_cast<Eigen::Index>(order_.size()))
              .second) {
        sights_.push_back(*measurement);
      }
    }
  }

  void run(const std::vector<std::int64_t>& epochs) const;

 private:
  static TrackManagerConfig same_states(TrackManagerConfig config) {
    config.filter.place_share = 0.0;  // the same states at both ends
    return config;
  }
  std::vector<BiasPrior> priors(const Eigen::Vector3d& p_ecef) const;
  Eigen::VectorXd prior(const std::vector<BiasPrior>& biases) const;
  Whole both(const std::optional<TrackFilter>& from_past,
             const std::optional<TrackFilter>& from_future, const Eigen::VectorXd& variance) const;
  Smoothed at(std::int64_t epoch_us, const RecordedTrack& forward, Passed future) const;
  std::vector<Runner> block_ends(const std::vector<std::int64_t>& epochs, std::size_t block) const;
  Runner backward() const { return {learnt_, &bearings_, &beside_, &output_.tell, about_us_}; }

  const BearingPointers& bearings_;
  std::int64_t about_us_;
  const SmootherOutput& output_;
  std::set<std::string> beside_;
  RecordedTrack learnt_;  // empty, with the learnt errors of the stations
  Order order_;
  std::vector<BearingMeasurement> sights_;  // one of each station, in that order
};

std::vector<BiasPrior> Smoother::priors(const Eigen::Vector3d& p_ecef) const {
  std::vector<BiasPrior> biases;
  for (const BearingMeasurement& measurement : sights_) {
    const double range_m = (p_ecef - measurement.sight.origin_ecef).norm();
    biases.push_back(learnt_.errors().prior(measurement.station, measurement.sight, range_m, true));
  }
  return biases;
}

// Variances of the stations' states before any bearing.
Eigen::VectorXd Smoother::prior(const std::vector<BiasPrior>& biases) const {
  Eigen::VectorXd variance = Eigen::VectorXd::Zero(9 + kStationStates * std::ssize(sights_));
  for (std::size_t i = 0; i < sights_.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(9 + kStationStates * i);
    variance.segment<3>(at) = biases[i].rotation.max(kLeast);
    variance(at + 3) = std::max(kLeast, sights_[i].clock_sd_s * sights_[i].clock_sd_s);
    variance.segment<kPlaceStates>(at + kPoseStates) = biases[i].place_m2.max(kLeast);
  }
  return variance;
}

// Both filters' states at the instant; one alone if the other has none or they cannot be joined.
Whole Smoother::both(const std::optional<TrackFilter>& from_past,
                     const std::optional<TrackFilter>& from_future,
                     const Eigen::VectorXd& variance) const {
  if (!from_past) return spread(*from_future, order_, variance, -1.0);
  const Whole before = spread(*from_past, order_, variance, 1.0);
  if (!from_future) return before;
  Whole after = spread(*from_future, order_, variance, -1.0);
  forget_acceleration(after);
  return join(before, after, variance).value_or(before);
}

Smoothed Smoother::at(std::int64_t epoch_us, const RecordedTrack& forward, Passed future) const {
  Smoothed fix{epoch_us, {}};
  Passed past(forward);
  leave_worth_joining(past, future);
  std::optional<TrackFilter>&from_past = past.filter, &from_future = future.filter;
  if (!from_past && !from_future) {
    fix.located.estimate.solution = forward.why_none(epoch_us);
    return fix;
  }
  BiasModel shown = BiasModel::evidence_on(learnt_.errors());
  if (from_past) shown.learn(from_past->advance(epoch_us, shown));
  if (from_future) shown.learn(from_future->advance(about_us_ - epoch_us, shown));
  const TrackFilter& any = from_past ? *from_past : *from_future;
  const std::vector<BiasPrior> biases = priors(any.position());
  const Whole joint = both(from_past, from_future, prior(biases));
  KinematicState state{any.utime_us(), joint.mean.head<9>(),
                       joint.covariance.topLeftCorner<9, 9>()};
  const SystematicPart part = told_biases(from_past, from_future);
  state.covariance.topLeftCorner<3, 3>() +=
      part.all_m2 - systematic_part(joint.covariance, biases).all_m2;
  fix.located.estimate = estimate_of(any, state, part);
  fix.located.stations = contributing(any, any.utime_us());
  return fix;
}

// The backward run at the end of each block, the last block's first.
std::vector<Runner> Smoother::block_ends(const std::vector<std::int64_t>& epochs,
                                         std::size_t block) const {
  std::vector<Runner> ends;
  Runner run = backward();
  for (std::size_t first = (epochs.size() - 1) / block * block;; first -= block) {
    ends.push_back(run);
    if (first == 0) break;
    run.run(about_us_ - epochs[first], false);
  }
  return ends;
}

void Smoother::run(const std::vector<std::int64_t>& epochs) const {
  constexpr std::size_t kLeastBlock = 256;
  const auto block = std::max(
      kLeastBlock, static_cast<std::size_t>(std::sqrt(static_cast<double>(epochs.size()))));
  std::vector<Runner> ends = block_ends(epochs, block);
  Runner forward{learnt_, &bearings_, &beside_, &output_.tell};
  for (std::size_t first = 0; first < epochs.size(); first += block) {
    std::vector<Passed> future;
    for (std::size_t i = std::min(first + block, epochs.size()); i-- > first;) {
      ends.back().run(about_us_ - epochs[i], false);
      future.emplace_back(ends.back().track);
    }
    ends.pop_back();
    for (std::size_t i = first; !future.empty(); ++i) {
      forward.run(epochs[i], true);
      output_.take(at(epochs[i], forward.track, std::move(future.back())));
      future.pop_back();
    }
  }
}

}  // namespace

void smooth(const BearingPointers& bearings, const std::vector<std::int64_t>& epochs,
            const TrackManagerConfig& config, const KnownStations& known,
            const SmootherOutput& output) {
  if (bearings.empty() || epochs.empty()) return;
  Smoother(bearings, config, known, output).run(epochs);
}

}  // namespace ols::fusion
