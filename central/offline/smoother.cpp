#include "central/offline/smoother.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <utility>

namespace ols::fusion {
namespace {

// The whole state of a filter at an instant, its stations in a fixed order.
struct Whole {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

// Least variance, so that matrices can be inverted: 10 ns, 10 nrad, 10 nm.
constexpr double kLeast = 1e-16;

// Instants per block. Stored are both runs at each instant of a block, and the backward run at the
// end of each block: this length makes the total smallest.
std::size_t block_of(std::size_t epochs) {
  constexpr std::size_t kLeastBlock = 128;
  // Size of a run (72 kB for four stations, with its recent bearings) over that of both at an
  // instant.
  constexpr double kRunOverInstant = 3.0;
  return std::max(kLeastBlock, static_cast<std::size_t>(
                                   std::sqrt(kRunOverInstant * static_cast<double>(epochs))));
}

using Order = std::map<std::string, Eigen::Index>;  // station -> first of its states

// The state extended to these stations' states; those that it does not hold get their prior.
Whole spread(const TrackFilter& filter, const FilterGaussian& mixed, const Order& order,
             const Eigen::VectorXd& prior, double clock_sign) {
  const auto& [mean, covariance] = mixed;
  std::vector<Eigen::Index> to(static_cast<std::size_t>(mean.size()));
  std::vector<double> sign(to.size(), 1.0);
  for (std::size_t i = 0; i < 9; ++i) to[i] = static_cast<Eigen::Index>(i);
  for (std::size_t i = 3; i < 6; ++i) sign[i] = clock_sign;  // velocities turn with time
  std::size_t k = 9;
  for (std::size_t i = 0; i < filter.stations().size(); ++i) {
    const Eigen::Index first = order.at(filter.stations()[i].station);
    sign[k + kClockState] = clock_sign;
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

// Both runs contain the prior that no acceleration is expected. It is removed from one of them, or
// it would count twice.
void forget_acceleration(Whole& whole) {
  constexpr double kUnknown = 1e12;
  whole.mean.segment<3>(6).setZero();
  whole.covariance.middleRows<3>(6).setZero();
  whole.covariance.middleCols<3>(6).setZero();
  whole.covariance.diagonal().segment<3>(6).setConstant(kUnknown);
}

// The target's nine states, given these biases.
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

// What is kept of a run at an instant.
struct Passed {
  std::optional<TrackFilter> filter;  // nothing: no position
  bool is_initiated = false;
  Solution why_none = Solution::kOk;

  Passed(const RecordedTrack& track, std::int64_t epoch_us) : is_initiated(track.is_initiated()) {
    if (const Track* const located = track.located()) {
      filter = located->filter;
    } else {
      why_none = track.why_none(epoch_us);
    }
  }
};

// A track that still rests on two rays is not joined, because one of them may be wrong: the other
// run's track is used alone. If both rest on two rays, the one from the past is used.
void leave_worth_joining(Passed& past, Passed& future) {
  if (!past.filter || !future.filter) return;
  if (!future.is_initiated) {
    future.filter.reset();
  } else if (!past.is_initiated) {
    past.filter.reset();
  }
}

// A filter at the instant, mixed once.
struct Side {
  const TrackFilter* filter;
  FilterGaussian mixed;

  explicit Side(const TrackFilter& at) : filter(&at), mixed(at.mixed()) {}
  SystematicPart systematic() const { return systematic_part(mixed.covariance, filter->priors()); }
  bool holds(const std::string& station) const {
    return std::ranges::find(filter->stations(), station, &FilterStation::station) !=
           filter->stations().end();
  }
};

// The filter that knows the biases better. Both runs are given its biases: how fast biases change
// is known worst of all, and a bias that is constant over seconds is the same before and after.
const Side& surer(const std::optional<Side>& from_past, const std::optional<Side>& from_future) {
  if (!from_past) return *from_future;
  if (!from_future) return *from_past;
  const double before = from_past->systematic().all_m2.trace();
  return from_future->systematic().all_m2.trace() < before ? *from_future : *from_past;
}

// Processes the bearings up to an instant, forwards, or backwards in mirrored time.
struct Runner {
  RecordedTrack track;
  const BearingPointers* bearings;
  const std::set<std::string>* beside;
  std::function<void()> tell;
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
    if (tell) tell();
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
    has_places_ = std::ranges::any_of(bearings, [](const BearingMeasurement* measurement) {
      return !measurement->sight.origin_sd_enu_m.isZero(0.0) || measurement->sight.aim_sd_rad > 0.0;
    });
    for (const BearingMeasurement* measurement : bearings) {
      sights_.try_emplace(measurement->station, *measurement);
    }
  }

  void run(std::span<const std::int64_t> epochs) const {
    Runner forward{learnt_, &bearings_, &beside_, output_.tell};
    std::vector<Runner> ends = ends_of(epochs);
    const std::size_t block = block_of(epochs.size());
    for (std::size_t first = 0; first < epochs.size(); first += block) {
      run_block(epochs.subspan(first, std::min(block, epochs.size() - first)),
                std::move(ends.back()), forward);
      ends.pop_back();
    }
  }

 private:
  static TrackManagerConfig same_states(TrackManagerConfig config) {
    config.filter.place_share = 0.0;  // both runs have the same states
    return config;
  }
  Eigen::Index states() const { return has_places_ ? kStationStates : kPoseStates; }
  Order held_by(const std::optional<Side>& from_past, const std::optional<Side>& from_future) const;
  Eigen::VectorXd prior(const Order& held, const Eigen::Vector3d& p_ecef) const;
  Whole both(const std::optional<Side>& from_past, const std::optional<Side>& from_future,
             const Eigen::Vector3d& p_ecef) const;
  Smoothed at(std::int64_t epoch_us, Passed& past, Passed& future) const;
  std::vector<Runner> ends_of(std::span<const std::int64_t> epochs) const;
  void run_block(std::span<const std::int64_t> epochs, Runner end, Runner& forward) const;

  const BearingPointers& bearings_;
  std::int64_t about_us_;
  const SmootherOutput& output_;
  std::set<std::string> beside_;
  RecordedTrack learnt_;     // empty, with the learnt errors of the stations
  bool has_places_ = false;  // some station states an error of its position or its aim
  std::map<std::string, BearingMeasurement> sights_;  // the first of each station
};

// The stations that either filter holds: the others say nothing at this instant.
Order Smoother::held_by(const std::optional<Side>& from_past,
                        const std::optional<Side>& from_future) const {
  Order held;
  for (const auto* side : {&from_past, &from_future}) {
    if (!*side) continue;
    for (const FilterStation& station : (*side)->filter->stations())
      held.try_emplace(station.station, 9 + states() * std::ssize(held));
  }
  return held;
}

// Variances of these stations' states before any bearing, for a target at this place.
Eigen::VectorXd Smoother::prior(const Order& held, const Eigen::Vector3d& p_ecef) const {
  Eigen::VectorXd variance = Eigen::VectorXd::Zero(9 + states() * std::ssize(held));
  for (const auto& [station, at] : held) {
    const BearingMeasurement& own = sights_.at(station);
    const double range_m = (p_ecef - own.sight.origin_ecef).norm();
    const BiasPrior bias = learnt_.errors().prior(station, own.sight, range_m, has_places_);
    variance.segment<3>(at) = bias.rotation.max(kLeast);
    const double clock_scale = learnt_.errors().clock_scale(station);
    variance(at + kClockState) = std::max(kLeast, clock_scale * own.clock_sd_s * own.clock_sd_s);
    variance(at + kCameraState) = std::max(kLeast, bias.camera);
    if (has_places_) {
      variance.segment<kPlaceStates>(at + kPoseStates) =
          bias.place_m2.diagonal().array().max(kLeast);
    }
  }
  return variance;
}

// The target's states at the instant, with both runs given the biases of the surer filter. Where
// the other filter's biases differ, they show how biases change, not what they are.
Whole Smoother::both(const std::optional<Side>& from_past, const std::optional<Side>& from_future,
                     const Eigen::Vector3d& p_ecef) const {
  const Order held = held_by(from_past, from_future);
  const Eigen::VectorXd variance = prior(held, p_ecef);
  const auto whole = [&](const Side& side, double clock_sign) {
    return spread(*side.filter, side.mixed, held, variance, clock_sign);
  };
  const Eigen::Index n = variance.size() - 9;
  if (!from_future) {
    const Whole before = whole(*from_past, 1.0);
    return given(before.mean.tail(n), before);
  }
  Whole after = whole(*from_future, -1.0);
  if (!from_past) return given(after.mean.tail(n), after);
  const Whole before = whole(*from_past, 1.0);
  const bool past_is_surer = &surer(from_past, from_future) == &*from_past;
  Eigen::VectorXd biases = (past_is_surer ? before : after).mean.tail(n);
  const Eigen::VectorXd others = (past_is_surer ? after : before).mean.tail(n);
  for (const auto& [station, at] : held) {
    if (!surer(from_past, from_future).holds(station))
      biases.segment(at - 9, states()) = others.segment(at - 9, states());
  }
  forget_acceleration(after);
  const Whole first = given(biases, before);
  return join(first, given(biases, after)).value_or(first);
}

Smoothed Smoother::at(std::int64_t epoch_us, Passed& past, Passed& future) const {
  Smoothed fix{epoch_us, {}};
  leave_worth_joining(past, future);
  if (!past.filter && !future.filter) {
    fix.located.estimate.solution = past.why_none;
    return fix;
  }
  BiasModel evidence = BiasModel::evidence_on(learnt_.errors());
  std::optional<Side> from_past, from_future;
  if (past.filter) {
    evidence.learn(past.filter->advance(epoch_us, evidence));
    from_past.emplace(*past.filter);
  }
  if (future.filter) {
    evidence.learn(future.filter->advance(about_us_ - epoch_us, evidence));
    from_future.emplace(*future.filter);
  }
  const TrackFilter& any = past.filter ? *past.filter : *future.filter;
  const Whole joint = both(from_past, from_future, any.position());
  KinematicState state{any.utime_us(), joint.mean.head<9>(), joint.covariance};
  // The position gets the biases' uncertainty; the velocity's covariance already has that of the
  // clocks.
  const Side& side = surer(from_past, from_future);
  const SystematicPart part = side.systematic();
  state.covariance.topLeftCorner<3, 3>() += part.all_m2;
  state.covariance.block<3, 3>(3, 3) = side.mixed.covariance.block<3, 3>(3, 3);
  fix.located.estimate = estimate_of(any, state, part);
  fix.located.stations = contributing(any, any.utime_us());
  return fix;
}

// Both runs at the instants of a block, then what they give together: each instant by itself.
void Smoother::run_block(std::span<const std::int64_t> epochs, Runner end, Runner& forward) const {
  std::vector<Passed> past, future;
  past.reserve(epochs.size());
  future.reserve(epochs.size());
  const auto backwards = [&] {
    for (std::size_t i = epochs.size(); i-- > 0;) {
      end.run(about_us_ - epochs[i], false);
      future.emplace_back(end.track, epochs[i]);
    }
  };
  const auto forwards = [&] {
    for (const std::int64_t epoch_us : epochs) {
      forward.run(epoch_us, true);
      past.emplace_back(forward.track, epoch_us);
    }
  };
  output_.workers.run({backwards, forwards});
  std::vector<Smoothed> fixes(epochs.size());
  Tasks joins;
  for (std::size_t share = 0; share < output_.workers.count; ++share) {
    joins.emplace_back([&, share] {
      for (std::size_t i = share; i < epochs.size(); i += output_.workers.count)
        fixes[i] = at(epochs[i], past[i], future[epochs.size() - 1 - i]);
    });
  }
  output_.workers.run(joins);
  for (Smoothed& fix : fixes) output_.take(std::move(fix));
}

// The backward run at the end of each block, the last block's first.
std::vector<Runner> Smoother::ends_of(std::span<const std::int64_t> epochs) const {
  const std::size_t block = block_of(epochs.size());
  std::vector<Runner> ends;
  ends.reserve((epochs.size() - 1) / block + 1);  // to grow would copy them all
  Runner end{learnt_, &bearings_, &beside_, output_.tell, about_us_};
  for (std::size_t first = (epochs.size() - 1) / block * block;; first -= block) {
    ends.push_back(end);
    if (first == 0) return ends;
    end.run(about_us_ - epochs[first], false);
  }
}

}  // namespace

void smooth(const BearingPointers& bearings, const std::vector<std::int64_t>& epochs,
            const TrackManagerConfig& config, const KnownStations& known,
            const SmootherOutput& output) {
  if (bearings.empty() || epochs.empty()) return;
  Smoother(bearings, config, known, output).run(epochs);
}

std::size_t smoother_runs(std::size_t epochs) { return epochs > block_of(epochs) ? 3 : 2; }

}  // namespace ols::fusion
