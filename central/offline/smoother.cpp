#include "central/offline/smoother.h"

#include <Eigen/Cholesky>
#include <algorithm>
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

// The target's nine states if the stations' are these.
Whole given(const Eigen::VectorXd& biases, const Whole& whole) {
  const Eigen::Index n = whole.mean.size() - 9;
  const Eigen::MatrixXd cross = whole.covariance.bottomLeftCorner(n, 9);
  const Eigen::MatrixXd own = whole.covariance.bottomRightCorner(n, n);
  const Eigen::MatrixXd moves = own.ldlt().solve(cross).transpose();
  return {whole.mean.head<9>() + moves * (biases - whole.mean.tail(n)),
          whole.covariance.topLeftCorner<9, 9>() - moves * cross};
}

// The sum of both informations.
std::optional<Whole> join(const Whole& a, const Whole& b) {
  const Eigen::LDLT<Eigen::MatrixXd> Pa(a.covariance), Pb(b.covariance);
  const auto n = a.mean.size();
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(n, n);
  const Eigen::LDLT<Eigen::MatrixXd> joint(Pa.solve(one) + Pb.solve(one));
  if (joint.info() != Eigen::Success || !joint.isPositive()) return std::nullopt;
  // Relative to the first mean: coordinates of millions of metres would cost digits.
  return Whole{a.mean + joint.solve(Pb.solve(b.mean - a.mean)), joint.solve(one)};
}

std::vector<BearingMeasurement> mirrored(std::vector<BearingMeasurement> bearings,
                                         std::int64_t about_us) {
  for (BearingMeasurement& measurement : bearings)
    measurement.utime_us = about_us - measurement.utime_us;
  std::ranges::reverse(bearings);
  return bearings;
}

// The forward and the backward track. A track that still rests on two rays, one of which may be
// wrong, is not joined: it is used alone, and only if the other is no better.
std::pair<const Track*, const Track*> worth_joining(const RecordedTrack& forward,
                                                    const RecordedTrack& backward) {
  const Track *ahead = forward.located(), *behind = backward.located();
  if (ahead == nullptr || behind == nullptr) return {ahead, behind};
  if (!backward.is_initiated()) return {ahead, nullptr};
  if (!forward.is_initiated()) return {nullptr, behind};
  return {ahead, behind};
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

// Processes the bearings up to an instant.
struct Runner {
  RecordedTrack track;
  const std::vector<BearingMeasurement>* bearings;
  const std::set<std::string>* beside;
  std::size_t next = 0;

  void run(std::int64_t utime_us, bool inclusive) {
    for (; next < bearings->size(); ++next) {
      const BearingMeasurement& measurement = (*bearings)[next];
      if (measurement.utime_us > utime_us || (measurement.utime_us == utime_us && !inclusive))
        break;
      track.advance(measurement.utime_us);
      track.add(measurement, !beside->contains(measurement.station));
    }
  }
};

class Smoother {
 public:
  Smoother(const std::vector<BearingMeasurement>& bearings, const TrackManagerConfig& config,
           const KnownStations& known)
      : forward_(bearings),
        about_us_(bearings.front().utime_us + bearings.back().utime_us),
        backward_(mirrored(bearings, about_us_)),
        beside_(known.beside),
        learnt_(same_states(config)) {
    learnt_.set_errors(known.errors);
    for (const std::string& station : beside_) learnt_.forget_station(station);
    for (const BearingMeasurement& measurement : bearings) {
      if (order_
              .try_emplace(measurement.station,
                           9 + kStationStates * static_cast<Eigen::Index>(order_.size()))
              .second) {
        sights_.push_back(measurement);
      }
    }
  }

  std::vector<Smoothed> run(const std::vector<std::int64_t>& epochs, Unlocated& unlocated);

 private:
  static TrackManagerConfig same_states(TrackManagerConfig config) {
    config.filter.place_share = 0.0;  // the same states at both ends
    return config;
  }
  std::vector<BiasPrior> priors(const Eigen::Vector3d& p_ecef) const;
  Eigen::VectorXd prior(const std::vector<BiasPrior>& biases) const;
  Whole both(const std::optional<TrackFilter>& from_past,
             const std::optional<TrackFilter>& from_future, const Eigen::VectorXd& variance) const;
  Smoothed at(std::int64_t epoch_us, const RecordedTrack& forward,
              const RecordedTrack& backward) const;

  const std::vector<BearingMeasurement>& forward_;
  std::int64_t about_us_;
  std::vector<BearingMeasurement> backward_;
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
    const double clock_scale = learnt_.errors().clock_scale(sights_[i].station);
    variance(at + 3) =
        std::max(kLeast, clock_scale * sights_[i].clock_sd_s * sights_[i].clock_sd_s);
    variance.segment<kPlaceStates>(at + kPoseStates) = biases[i].place_m2.max(kLeast);
  }
  return variance;
}

// The target's states at the instant for the biases of the surer filter, which both have in common:
// how the other's differ shows how biases change, not what they are.
Whole Smoother::both(const std::optional<TrackFilter>& from_past,
                     const std::optional<TrackFilter>& from_future,
                     const Eigen::VectorXd& variance) const {
  std::optional<Whole> before, after;
  if (from_past) before = spread(*from_past, order_, variance, 1.0);
  if (from_future) after = spread(*from_future, order_, variance, -1.0);
  if (!after) return given(before->mean.tail(variance.size() - 9), *before);
  if (!before) return given(after->mean.tail(variance.size() - 9), *after);
  forget_acceleration(*after);
  const bool past_is_surer =
      from_past->systematic().all_m2.trace() <= from_future->systematic().all_m2.trace();
  const Eigen::VectorXd biases = (past_is_surer ? before : after)->mean.tail(variance.size() - 9);
  const Whole first = given(biases, *before);
  return join(first, given(biases, *after)).value_or(first);
}

Smoothed Smoother::at(std::int64_t epoch_us, const RecordedTrack& forward,
                      const RecordedTrack& backward) const {
  Smoothed fix{epoch_us, {}};
  const auto [ahead, behind] = worth_joining(forward, backward);
  if (ahead == nullptr && behind == nullptr) {
    fix.located.estimate.solution = forward.why_none(epoch_us);
    return fix;
  }
  BiasModel shown = BiasModel::evidence_on(learnt_.errors());
  std::optional<TrackFilter> from_past, from_future;
  if (ahead != nullptr) {
    shown.learn(from_past.emplace(ahead->filter).advance(epoch_us, shown));
  }
  if (behind != nullptr) {
    shown.learn(from_future.emplace(behind->filter).advance(about_us_ - epoch_us, shown));
  }
  const TrackFilter& any = from_past ? *from_past : *from_future;
  const std::vector<BiasPrior> biases = priors(any.position());
  const Whole joint = both(from_past, from_future, prior(biases));
  KinematicState state{any.utime_us(), joint.mean.head<9>(), joint.covariance};
  const SystematicPart part = told_biases(from_past, from_future);
  state.covariance.topLeftCorner<3, 3>() += part.all_m2;
  fix.located.estimate = estimate_of(any, state, part);
  fix.located.stations = contributing(any, any.utime_us());
  return fix;
}

std::vector<Smoothed> Smoother::run(const std::vector<std::int64_t>& epochs, Unlocated& unlocated) {
  constexpr std::size_t kBlock = 256;  // epochs between stored forward states
  std::vector<Runner> starts;
  Runner forward{learnt_, &forward_, &beside_};
  for (std::size_t i = 0; i < epochs.size(); i += kBlock) {
    starts.push_back(forward);
    forward.run(epochs[std::min(i + kBlock, epochs.size()) - 1], true);
  }
  std::vector<Smoothed> fixes;
  Runner backward{learnt_, &backward_, &beside_};
  for (std::size_t block = starts.size(); block-- > 0;) {
    const std::size_t first = block * kBlock, last = std::min(first + kBlock, epochs.size());
    std::vector<RecordedTrack> past;
    for (std::size_t i = first; i < last; ++i) {
      starts[block].run(epochs[i], true);
      past.push_back(starts[block].track);
    }
    for (std::size_t i = last; i-- > first;) {
      backward.run(about_us_ - epochs[i], false);
      Smoothed fix = at(epochs[i], past[i - first], backward.track);
      const Solution solution = fix.located.estimate.solution;
      if (solution == Solution::kOk) {
        fixes.push_back(std::move(fix));
      } else {
        ++unlocated[solution];
      }
    }
    starts.pop_back();
  }
  std::ranges::reverse(fixes);
  return fixes;
}

}  // namespace

std::vector<Smoothed> smooth(const std::vector<BearingMeasurement>& bearings,
                             const std::vector<std::int64_t>& epochs,
                             const TrackManagerConfig& config, const KnownStations& known,
                             Unlocated& unlocated) {
  if (bearings.empty()) return {};
  return Smoother(bearings, config, known).run(epochs, unlocated);
}

}  // namespace ols::fusion
