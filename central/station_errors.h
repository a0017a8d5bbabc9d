// What stays in each station's bearings: what it states of its calibration, and what its residuals
// show beyond that. Pure.
//
// The filter carries each station's bias (cross-elevation, elevation) as a state with a prior of
// zero mean. The prior's variance is learnt here, by expectation maximisation (empirical Bayes): a
// bias estimated as b with the variance P is worth b^2 + P. Where the geometry does not show a bias
// that is the prior itself, and nothing is learnt; where it does, it is the bias. A source that
// tells no systematic error is first taken to have one of the size of its noise; what the others
// show of theirs, in units of their noise, counts for it too. There is no length and no time scale
// in this but that of the bias' own memory, so it holds for a drone and for a meteor.
//
// Noise is rarely white: a tracker's error, or a hand's, is nearly the same in the next frame. How
// much of it is new in each frame is seen in the second differences of a station's own bearings,
// from which the target's motion drops out. The rest averages out more slowly, and each bearing is
// worth that much less.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>

#include "geometry/direction.h"

namespace ols {

struct StationErrorsConfig {
  double stated_time_s = 60.0;     // correlation time of a bias within what is stated
  double untold_time_s = 10.0;     // and of one that the station does not tell
  double memory_s = 120.0;         // what was seen longer ago counts less than 1/e
  double stated_weight = 20.0;     // seen biases that a statement is worth
  double untold_weight = 2.0;      // and that the guess is worth where nothing is stated
  double untold_over_noise = 1.0;  // that guess: sd of the bias over the sd of the noise
  double clock_time_s = 5.0;       // correlation time of a clock's error
  double colour_time_s = 0.1;      // and of the noise that is not new in each frame
  double colour_memory = 500.0;    // second differences in whose mean the share is judged
};

// The prior of one station's bias as seen towards a target.
struct BiasPrior {
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // [rad^2] stationary
  double time_s = 1.0;                                   // correlation time
};

class StationErrors {
 public:
  explicit StationErrors(const StationErrorsConfig& config = {}) : config_(config) {}

  // Stays of the sight line itself: calibration, and the station's place seen from the range.
  BiasPrior prior(const std::string& station, const SightLine& sight, double range_m) const;
  // The same, added to what a ray states, for estimators without bias states [rad^2].
  Eigen::Matrix2d untold(const std::string& station, const SightLine& sight) const;
  // A bias as the filter has it, over dt_s since it was told last.
  void observe(const std::string& station, const SightLine& sight, const Eigen::Vector2d& bias,
               const Eigen::Matrix2d& covariance, double dt_s, double range_m);
  // A second difference of a station's bearings, squared, over what white noise as stated would
  // make.
  void observe_noise(const std::string& station, double squared_ratio);
  // How many times its stated variance a bearing counts with, when they come at this interval: 1 if
  // the noise is white.
  double inflation(const std::string& station, double interval_s) const;
  double clock_time_s() const { return config_.clock_time_s; }
  void forget(const std::string& station);
  void clear() { *this = StationErrors(config_); }

 private:
  struct Seen {
    Eigen::Array2d weight = Eigen::Array2d::Zero();
    Eigen::Array2d squared_rad2 = Eigen::Array2d::Zero();  // of what goes beyond the statement
    Eigen::Array2d noise_rad2 = Eigen::Array2d::Zero();    // of one bearing, lately
    double white_share = 1.0;                              // of its noise, new in each frame
  };
  void count(const Seen& seen, double sign);
  Eigen::Array2d learnt(const std::string& station, const Eigen::Array2d& stated_rad2,
                        const Eigen::Array2d& noise_rad2) const;

  StationErrorsConfig config_;
  std::map<std::string, Seen, std::less<>> stations_;
  // Over the stations that state nothing: weights, and squared biases over the noise's variance.
  Eigen::Array2d common_weight_ = Eigen::Array2d::Zero();
  Eigen::Array2d common_ratio_ = Eigen::Array2d::Zero();
};

// What a sight line states of its systematic error as seen towards a target at this range [rad^2].
Eigen::Matrix2d stated_covariance(const SightLine& sight, double range_m);

}  // namespace ols
