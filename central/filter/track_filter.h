// One target over time: an extended Kalman filter with mixed motion models that takes every bearing
// at its own instant. Pure.
//
// State: position, velocity, acceleration (ECEF components), and for each station that contributes
// the rotation that its pose is off by (about its east, north, up), its clock's offset and, where
// that matters, the error of its place. These are what stays while the tripod stands: the bias on
// the tangent plane changes with the direction. They are Gauss-Markov processes with the prior of
// BiasModel: where the geometry shows them they are estimated, where it does not they are only
// considered (Schmidt), and either way the position's covariance contains them, so that averaging
// does not make them go away.
//
// A bearing newer than the state moves it on. A late one is compared with where the target was at
// its own instant, by the state's own velocity and acceleration. A bearing far off is set aside,
// one a little off is weighted down; only consecutive rejections of two stations, or of one of the
// only two, say that the target has done what no model allows, and its covariance is inflated.
//
// The filter goes one way: it reads the priors of the stations' errors, and returns what a bearing
// shows of them. Whoever owns the priors learns it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "central/filter/bias_model.h"
#include "central/filter/coloured_noise.h"
#include "central/filter/consecutive_rejections.h"
#include "central/filter/innovation.h"
#include "central/filter/interacting_models.h"
#include "central/filter/station_bias.h"
#include "central/measurement/activity.h"
#include "central/measurement/bearing_measurement.h"
#include "central/measurement/ray.h"

namespace ols::fusion {

struct FilterConfig {
  MotionConfig motion{};
  double robust_nis = 9.0;      // squared normalised residual beyond which a bearing weighs less
  double gate_nis = 25.0;       // and beyond which it is set aside
  double mixing_s = 0.05;       // models are mixed and biases moved on at this interval
  double range_sd_limit = 0.3;  // greatest 1-sigma over range of a position that is one
  double max_range_m = 500e3;
  // What a station that states no error of its pose may be off by, with its clock, when it is asked
  // whether two rays cross widely enough to tell a range [rad].
  double undeclared_sd_rad = 1e-3;
  // Two stations alone: squared turn over what they state of bias and noise, beyond which their
  // rays are not made to meet.
  double two_stations_nis = 25.0;
  // A station's place has states of its own from when it makes at least so much of the stated
  // bias's variance on.
  double place_share = 0.005;
  // What all stations may have in common beyond what independent errors have, in variance: it moves
  // the target and no residual shows it. Over the part that biases make which the residuals show.
  double common_mode = 1.0;
};

// What became of a bearing. kNoFreeState: all the states are those of stations that still deliver.
// Their bearings without them would count as if each had a bias of its own, and none had any.
enum class BearingUse { kUsed, kRejected, kBehindCamera, kTooLate, kNoFreeState };

// A contributing station.
struct FilterStation {
  std::string station;
  LineOfSight sight;                                         // its last bearing
  Eigen::Matrix3d R_ecef_enu = Eigen::Matrix3d::Identity();  // at that one's origin
  Activity last_used, last_offered;
  int used = 0;                                   // bearings
  int rejected = 0;                               // set aside since the last used one
  std::int64_t calibration_id = 0, track_id = 0;  // with others its bias is another
  double weight = 0.0;                            // of the last one, 0: set aside
  double clock_sd_s = 0.0;
  double mean_nis = 2.0;  // lately, of bearings that were used; 2 is ideal
  ColouredNoise noise{};
};

// What an update has made of a bearing, and what that shows of the stations' errors: evidence on
// top of the priors that the update was given.
struct FilterUpdate {
  BearingUse use = BearingUse::kTooLate;
  double nis = std::numeric_limits<double>::infinity();  // where the bearing was compared at all
  BiasModel shown;
};

class TrackFilter {
 public:
  // A start for the first bearings. std::invalid_argument for a configuration without models.
  TrackFilter(const FilterConfig& config, std::int64_t utime_us, const FilterStart& start);

  Innovation innovation(const BearingMeasurement& sighting, const BiasModel& priors) const;
  // `known`: the bearing's innovation() with the same priors, where it is at hand.
  [[nodiscard]] FilterUpdate update(const BearingMeasurement& sighting, const BiasModel& priors,
                                    const Innovation* known = nullptr);
  // Moves the state on without a bearing; gives what the biases by then show.
  [[nodiscard]] BiasModel advance(std::int64_t utime_us, const BiasModel& priors);
  // The bearings' equations are linear about this motion, instead of about what is known so far:
  // for another round over the same bearings, while that is vague.
  void linearise_about(const KinematicState& motion) { about_ = motion; }
  void linearise_about_itself() { about_.reset(); }

  std::int64_t utime_us() const { return models_.utime_us(); }
  // Mixed over the models, at an instant before or after the state's own.
  KinematicState at(std::int64_t utime_us) const { return models_.at(utime_us); }
  SystematicPart systematic() const { return systematic_part(mixed().covariance, priors_); }
  // at() the state's own instant; at hand.
  const KinematicState& summary() const { return summary_; }
  Eigen::Vector3d position() const { return summary_.mean.head<3>(); }
  Eigen::Vector3d velocity() const { return summary_.mean.segment<3>(3); }
  const std::vector<FilterStation>& stations() const { return stations_; }
  const std::vector<BiasPrior>& priors() const { return priors_; }  // of each
  // How many others have had a bearing used since this one's last.
  std::ptrdiff_t agreed_since(const FilterStation& station) const;
  StationBias bias(std::size_t station) const;
  const std::vector<double>& probabilities() const { return models_.probabilities(); }
  // The whole mixed state, for the smoother: kinematics, then the stations' states.
  FilterGaussian mixed() const { return models_.mixed(); }
  const FilterConfig& config() const { return config_; }

 private:
  RayFrame frame_of(const BearingMeasurement& sighting, int station) const;
  Eigen::Index first_of(int station) const;
  StationPart part_of(int station, const RayFrame& frame) const;
  int index_of(const std::string& station) const;
  bool place_matters(const LineOfSight& sight) const;
  int claim_station_states(const BearingMeasurement& sighting);
  void enter(int station, const BearingMeasurement& sighting, const BiasModel& priors);
  void reset_bias(int station, std::int64_t track_id);
  void add_position_states(int station);
  int station_of(const BearingMeasurement& sighting, const BiasModel& priors);
  Innovation compare(const BearingMeasurement& sighting, int station) const;
  // `along`: the bearing's direction where biases may be learnt of it.
  void correct(const Innovation& seen, const Eigen::Matrix2d& noise, const Eigen::Vector3d* along);
  void take(const BearingMeasurement& sighting, const Innovation* known, FilterUpdate& update);
  void note_use(FilterStation& entry, const BearingMeasurement& sighting, double nis) const;
  void predict(std::int64_t utime_us, BiasModel& shown);
  void move_biases(double dt_s, BiasModel& shown);
  void fade_biases(double dt_s, double clock_time_s);
  void reject(FilterStation& entry);
  void inflate(double time_s, const Eigen::Matrix3d& along);
  void inflate_unseen_by_other(const FilterStation& entry);
  void refresh() { summary_ = models_.kinematics(); }

  FilterConfig config_;
  InteractingModels models_;
  std::int64_t mixed_us_;   // when the models were mixed last
  std::int64_t state_ = 1;  // counts what changes the state: an innovation is of one of them
  std::vector<FilterStation> stations_;
  std::vector<BiasPrior> priors_;
  KinematicState summary_;  // mixed over the models
  std::optional<KinematicState> about_;
  ConsecutiveRejections rejections_;
};

}  // namespace ols::fusion
