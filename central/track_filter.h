// One target over time: an extended Kalman filter with mixed motion models that takes every bearing
// at its own instant. Pure.
//
// State: position, velocity, acceleration (ECEF components), and for each station that contributes
// the rotation that its pose is off by (about its east, north, up), its clock's offset and, where
// that matters, the error of its place. These are what stays while the tripod stands: the bias on
// the tangent plane changes with the direction. They are Gauss-Markov processes with the prior of
// StationErrors: where the geometry shows them they are estimated, where it does not they are only
// considered (Schmidt), and either way the position's covariance contains them, so that averaging
// does not make them go away.
//
// A bearing newer than the state moves it on. A late one is compared with where the target was at
// its own instant, by the state's own velocity and acceleration. Three models (motion_model.h) are
// mixed (IMM: Blom and Bar-Shalom, 1988). A bearing far off is set aside, one a little off is
// weighted down; only such ones of two stations in a row, or of one of the only two, say that the
// target has done what no model allows, and it is given room.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "central/filter_gaussian.h"
#include "central/motion_model.h"
#include "central/ray.h"
#include "central/sighting.h"
#include "central/station_errors.h"

namespace ols {

struct FilterConfig {
  MotionConfig motion{};
  double robust_nis = 9.0;      // squared normalised residual beyond which a bearing weighs less
  double gate_nis = 25.0;       // and beyond which it is set aside
  double mixing_s = 0.05;       // models are mixed and biases moved on at this interval
  double range_sd_limit = 0.3;  // greatest 1-sigma over range of a position that is one
  double max_range_m = 500e3;
  // What a station that states no error of its pose may be off by, with its clock, when it is asked
  // whether two rays cross widely enough to tell a range [rad].
  double untold_rad = 1e-3;
  // Two stations alone: squared turn over what they state of bias and noise, beyond which their
  // rays are not made to meet.
  double two_stations_nis = 25.0;
  // A station's place has states of its own from when it makes at least so much of the stated
  // bias's variance on.
  double place_share = 0.005;
  // What all stations may have in common beyond what independent errors have, in variance: it moves
  // the target and no residual shows it. Over the part that biases make which the residuals show.
  double in_common = 1.0;
};

inline Eigen::Index states_of(const BiasPrior& prior) {
  return prior.place_apart ? kStationStates : kPoseStates;
}
using StationMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kStationStates, kStationStates>;
using StationVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kStationStates, 1>;

// What became of a bearing. kNoPlace: all the states are those of stations that still deliver.
// Their bearings without them would count as if each had a bias of its own, and none had any.
enum class BearingUse { kUsed, kSetAside, kBehindCamera, kTooLate, kNoPlace };

// Position, velocity, acceleration; three components each.
struct KinematicState {
  std::int64_t utime_us = 0;
  Vector9 mean = Vector9::Zero();
  Matrix9 covariance = Matrix9::Zero();
};

// A contributing station.
struct FilterStation {
  std::string station;
  LineOfSight sight;                                         // its last bearing
  Eigen::Matrix3d R_ecef_enu = Eigen::Matrix3d::Identity();  // at that one's origin
  std::int64_t utime_us = 0;                                 // of the last one that was used
  std::int64_t offered_us = 0;                               // of the last one that was offered
  int used = 0;                                              // bearings
  int upset = 0;                                             // set aside since the last used one
  std::int64_t calibration_id = 0, track_id = 0;             // with others its bias is another
  double weight = 0.0;                                       // of the last one, 0: set aside
  double clock_sd_s = 0.0;
  double mean_nis = 2.0;  // lately, of bearings that were used; 2 is ideal
  // The two bearings before the next one, for the colour of their noise.
  std::array<std::int64_t, 2> before_us{};
  std::array<Eigen::Vector3d, 2> before{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
};

// The part of the position's covariance that the biases make, at the state's own instant; and of it
// what makes those that nobody stated and only the residuals show.
struct SystematicPart {
  Eigen::Matrix3d all_m2 = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d shown_m2 = Eigen::Matrix3d::Zero();
};

// Of the covariance of a whole state: position, velocity, acceleration, then states_of() each
// prior.
SystematicPart systematic_part(const Eigen::Ref<const Eigen::MatrixXd>& P,
                               const std::vector<BiasPrior>& priors);

struct StationBias {
  Eigen::Vector2d bias_rad = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_rad2 = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d prior_rad2 = Eigen::Matrix2d::Zero();
  double clock_s = 0.0;
  double clock_sd_s = 0.0;
  double clock_prior_sd_s = 0.0;
};

// Where a target may be and how it may move, with vague knowledge.
struct FilterStart {
  Eigen::Vector3d p_ecef = Eigen::Vector3d::Zero();
  Eigen::Vector3d v_ecef = Eigen::Vector3d::Zero();
  double position_sd_m = 0.0;
  double velocity_sd_m_s = 0.0;
};

class TrackFilter {
 public:
  // A start for the first bearings. std::invalid_argument for a configuration without models.
  TrackFilter(const FilterConfig& config, std::int64_t utime_us, const FilterStart& start);

  // The bearing's squared normalised residual (2 degrees of freedom); infinite behind the camera.
  double nis(const Sighting& sighting, const StationErrors& errors) const;
  BearingUse update(const Sighting& sighting, StationErrors& errors);
  // Moves the state on without a bearing.
  void advance(std::int64_t utime_us, StationErrors& errors);
  // The bearings' equations are linear about this motion, instead of about what is known so far:
  // for another round over the same bearings, while that is vague.
  void linearise_about(const KinematicState& motion) { about_ = motion; }
  void linearise_about_itself() { about_.reset(); }

  std::int64_t utime_us() const { return utime_us_; }
  // Mixed over the models, at an instant before or after the state's own.
  KinematicState at(std::int64_t utime_us) const;
  SystematicPart systematic() const;
  // at() the state's own instant; at hand.
  const KinematicState& summary() const { return summary_; }
  Eigen::Vector3d position() const { return summary_.mean.head<3>(); }
  Eigen::Vector3d velocity() const { return summary_.mean.segment<3>(3); }
  const std::vector<FilterStation>& stations() const { return stations_; }
  const std::vector<BiasPrior>& priors() const { return priors_; }  // of each
  // How many others have had a bearing used since this one's last.
  std::ptrdiff_t agreed_since(const FilterStation& station) const;
  StationBias bias(std::size_t station) const;
  const std::vector<double>& probabilities() const { return probabilities_; }  // of each model
  // The whole mixed state, for the smoother: kinematics, then the stations' states.
  FilterGaussian mixed() const;
  const FilterConfig& config() const { return config_; }

 private:
  struct Innovation;
  struct StationPart;
  using Innovations = std::array<Innovation, kMotions>;
  Innovation innovation(std::size_t model, const Sighting& sighting, const RayFrame& frame,
                        const StationPart* station) const;
  RayFrame frame_of(const Sighting& sighting, int station) const;
  Eigen::Index first_of(int station) const;
  StationPart part_of(int station, const RayFrame& frame) const;
  int index_of(const std::string& station) const;
  bool place_matters(const LineOfSight& sight) const;
  int take_place(const Sighting& sighting);
  void enter(int station, const Sighting& sighting, const StationErrors& errors);
  void show_anew(int station, std::int64_t track_id);
  void tell_place_apart(int station);
  int station_of(const Sighting& sighting, const StationErrors& errors);
  bool is_linear(const StationPart& part, const RayFrame& frame, double depth_m,
                 const Eigen::Matrix2d& white) const;
  static bool shows_bias(const FilterMatrix2& G, const FilterMatrix& P, const StationPart& part,
                         const Eigen::Vector3d& along, double off_share);
  // `along`: the bearing's direction where biases may be learnt of it.
  void correct(const Innovations& seen, const StationPart& part, const Eigen::Matrix2d& noise,
               const Eigen::Vector3d* along);
  struct Judged {
    double nis = std::numeric_limits<double>::infinity(), noise = 1.0;
  };
  std::optional<Judged> judge(const Innovations& seen, const Eigen::Matrix2d& white) const;
  BearingUse take(const Sighting& sighting, StationErrors& errors);
  void note_use(FilterStation& entry, const Sighting& sighting, double nis) const;
  void move_to(std::int64_t utime_us, StationErrors& errors);
  void mix(double dt_s);
  void move_biases(double dt_s, StationErrors& errors);
  void fade_biases(double dt_s, double clock_time_s);
  void give_room(double time_s, const Eigen::Matrix3d& along);
  void give_room_unseen_by_other(const FilterStation& entry);
  bool passes_gate(FilterStation& entry, double nis);
  static double observe_noise(FilterStation& entry, const Sighting& sighting, const RayFrame& frame,
                              StationErrors& errors);
  void weigh_models(std::span<const double> log_likelihood);
  const std::vector<Motion>& motions() const { return config_.motion.models; }
  void refresh();

  FilterConfig config_;
  std::int64_t utime_us_;
  std::int64_t mixed_us_;               // when the models were mixed last
  std::vector<FilterGaussian> models_;  // as motions()
  std::vector<double> probabilities_;
  std::vector<FilterStation> stations_;
  std::vector<BiasPrior> priors_;
  KinematicState summary_;  // mixed over the models
  std::optional<KinematicState> about_;
  int upset_ = 0;              // set-aside bearings since the last used one
  std::string upset_station_;  // of the first of them
  bool two_upset_ = false;     // another station's is among them
};

}  // namespace ols
