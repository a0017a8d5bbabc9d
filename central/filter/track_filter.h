// Tracks one target over time: an extended Kalman filter with interacting motion models. It
// processes every bearing at the bearing's own instant. Pure.
//
// The target's states are position, velocity and acceleration (ECEF components). The states of each
// contributing station are the rotation error of its pose (about its east, north, up), its clock's
// offset, and the elevation error that is fixed in its camera. If the errors of the station's
// position and aim matter at the target's range, the sum of these two errors has states, too. The
// rotation and the position error are constant while the tripod stands. The aim is constant until
// the next designation. The bias on the tangent plane that these errors cause nevertheless changes
// with the direction. All station states are Gauss-Markov processes with the prior of BiasModel.
// Observable errors are estimated; the others are only considered (Schmidt). The covariance of the
// target's position contains both kinds: averaging over many bearings does not remove them.
//
// If a bearing is newer than the state, the state is propagated to the bearing's instant. If the
// bearing is late, it is compared with the target's position extrapolated back to the bearing's
// instant, by velocity and acceleration. A bearing outside the gate is rejected. A bearing inside
// the gate but beyond robust_nis is down-weighted. Consecutive rejections from two stations, or
// from one station if only two deliver, indicate a manoeuvre that no motion model contains. The
// covariance is then inflated.
//
// The filter only reads the priors of the stations' errors. It returns what a bearing shows about
// these errors as evidence, from which the owner of the priors learns.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "central/filter/bias_model.h"
#include "central/filter/consecutive_rejections.h"
#include "central/filter/filter_station.h"
#include "central/filter/innovation.h"
#include "central/filter/interacting_models.h"
#include "central/filter/station_bias.h"
#include "central/measurement/activity.h"
#include "central/measurement/bearing_measurement.h"
#include "central/measurement/ray.h"

namespace ols::fusion {

struct FilterConfig {
  MotionConfig motion{};
  double robust_nis = 9.0;      // a bearing with a larger NIS is down-weighted
  double gate_nis = 25.0;       // a bearing with a larger NIS is rejected
  double mixing_s = 0.05;       // interval at which models are mixed and biases are propagated
  double range_sd_limit = 0.3;  // largest 1-sigma of a position, relative to the range
  double max_range_m = 500e3;
  // The assumed pose and clock error of a station that declares no bias [rad]. Rays of two such
  // stations determine a range only if they cross at a sufficient multiple of this error.
  double undeclared_sd_rad = 1e-3;
  // If only two stations deliver: the largest sum of the squares of their estimated biases,
  // normalised by stated bias and noise. If it is larger, the two are an inconsistent pair.
  double two_stations_nis = 25.0;
  // A station's position error and aim get states of their own when they make up at least this
  // share of the stated bias's variance.
  double place_share = 0.005;
  // Variance of the common-mode error, relative to the empirical part of the systematic variance. A
  // common-mode error is shared by all stations: it moves the target, and no residual shows it.
  double common_mode = 1.0;
};

// The fate of a bearing.
enum class BearingUse { kUsed, kRejected, kBehindCamera, kTooLate };

// The result of an update. `evidence`: what the bearing shows about the stations' errors, beyond
// the given priors.
struct FilterUpdate {
  BearingUse use = BearingUse::kTooLate;
  double nis = std::numeric_limits<double>::infinity();  // infinite if no comparison was made
  BiasModel evidence;
};

class TrackFilter {
 public:
  // start: the initial state, from the first bearings. Throws std::invalid_argument if there are no
  // motion models.
  TrackFilter(const FilterConfig& config, std::int64_t utime_us, const FilterStart& start);

  Innovation innovation(const BearingMeasurement& measurement, const BiasModel& priors) const;
  // `known`: the bearing's innovation() with the same priors, if available. It is used only if the
  // bearing is late. For a newer bearing, the state is first propagated to the bearing's instant,
  // and the innovation is computed again: the extrapolation in innovation() is accurate enough for
  // a gate, but not for a gain.
  [[nodiscard]] FilterUpdate update(const BearingMeasurement& measurement, const BiasModel& priors,
                                    const Innovation* known = nullptr);
  // Propagates the state without a bearing. Returns the evidence that the current bias estimates
  // give.
  [[nodiscard]] BiasModel advance(std::int64_t utime_us, const BiasModel& priors) {
    BiasModel evidence = BiasModel::evidence_on(priors);
    predict(utime_us, evidence);
    refresh();
    return evidence;
  }
  // From now on, linearises about this motion instead of about the current estimate. For repeated
  // runs over the same bearings, while the estimate is vague.
  void linearise_about(const KinematicState& motion) { about_ = motion; }
  void linearise_about_itself() { about_.reset(); }

  std::int64_t utime_us() const { return models_.utime_us(); }
  // The kinematics at any instant, mixed over the models.
  KinematicState at(std::int64_t utime_us) const { return models_.at(utime_us); }
  SystematicPart systematic() const { return systematic_part(mixed().covariance, priors_); }
  // The kinematics at the state's own instant; precomputed.
  const KinematicState& summary() const { return summary_; }
  Eigen::Vector3d position() const { return summary_.mean.head<3>(); }
  Eigen::Vector3d velocity() const { return summary_.mean.segment<3>(3); }
  // The stations that have states of their own, in the order of priors().
  const std::vector<FilterStation>& stations() const { return stations_; }
  // All contributing stations: those with states, then those without.
  template <class Visitor>
  void each_station(const Visitor& visit) const {
    for (const FilterStation& station : stations_) visit(station);
    for (const auto& [name, station] : without_states_) visit(station);
  }
  const std::vector<BiasPrior>& priors() const { return priors_; }  // for each station
  // The number of other stations that have a used bearing newer than this station's last used
  // bearing.
  std::ptrdiff_t agreed_since(const FilterStation& station) const {
    std::ptrdiff_t count = 0;
    each_station([&](const FilterStation& other) {
      count += other.last_used.last_us > station.last_used.last_us ? 1 : 0;
    });
    return count;
  }
  StationBias bias(std::size_t station) const;
  const std::vector<double>& probabilities() const { return models_.probabilities(); }
  // The whole mixed state, for the smoother: kinematics, then the stations' states.
  FilterGaussian mixed() const { return models_.mixed(); }
  const FilterConfig& config() const { return config_; }

 private:
  RayFrame frame_of(const BearingMeasurement& measurement, int station) const;
  Eigen::Index first_of(int station) const;
  StationPart part_of(int station, const RayFrame& frame) const;
  int index_of(const std::string& station) const {
    const auto found = std::ranges::find(stations_, station, &FilterStation::station);
    return found == stations_.end() ? -1 : static_cast<int>(found - stations_.begin());
  }
  bool place_matters(const LineOfSight& sight) const;
  int claim_station_states(const BearingMeasurement& measurement);
  BiasPrior prior_of(const BearingMeasurement& measurement, const BiasModel& priors,
                     bool position_states) const;
  void enter(int station, const BearingMeasurement& measurement, const BiasModel& priors);
  void reset_bias(int station, const BearingMeasurement& measurement, const BiasModel& priors);
  void add_position_states(int station);
  int station_of(const BearingMeasurement& measurement, const BiasModel& priors);
  Innovation compare(const BearingMeasurement& measurement, int station) const;
  // along: the bearing's direction, if biases may be estimated from the bearing; otherwise null.
  void correct(const Innovation& seen, const Eigen::Matrix2d& noise, const Eigen::Vector3d* along);
  void take_without_states(const BearingMeasurement& measurement, FilterUpdate& update);
  void take(const BearingMeasurement& measurement, const Innovation* known, FilterUpdate& update);
  double weight_of(double nis) const {
    return nis > config_.robust_nis ? config_.robust_nis / nis : 1.0;
  }
  void predict(std::int64_t utime_us, BiasModel& evidence);
  void move_biases(double dt_s, BiasModel& evidence);
  void fade_biases(double dt_s, double clock_time_s);
  void reject(FilterStation& entry);
  void inflate(double time_s, const Eigen::Matrix3d& along);
  void inflate_unseen_by_other(const FilterStation& entry);
  void refresh() { summary_ = models_.kinematics(); }

  FilterConfig config_;
  InteractingModels models_;
  std::int64_t mixed_us_;   // when the models were last mixed
  std::int64_t state_ = 1;  // version of the state; each innovation belongs to one
  std::vector<FilterStation> stations_;
  std::vector<BiasPrior> priors_;
  std::map<std::string, FilterStation> without_states_;  // by name
  KinematicState summary_;                               // mixed over the models
  std::optional<KinematicState> about_;
  ConsecutiveRejections rejections_;
};

}  // namespace ols::fusion
