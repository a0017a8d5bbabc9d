// What stays in each station's bearings: what it states of its calibration, and what its residuals
// show beyond that. Pure.
//
// The filter carries what makes each station's bias (cross-elevation, elevation) as states with a
// prior of zero mean. The variance v of the bias before any bearing is learnt here. A bias
// estimated as b with the variance P shows the share k = 1 - P / v of itself, and its square is
// worth b^2 - k P with the weight k^2 (one step of Fisher scoring on the marginal likelihood,
// Harville, 1977): nothing where the geometry does not show the bias, all where it does. A source
// that tells no systematic error is first taken to have one of half the size of its noise; what the
// others show of theirs, in units of what they state as noise, counts for it too. There is no
// length and no time scale in this but that of the bias' own memory, so it holds for a drone and
// for a meteor.
//
// How great the noise is, is seen in the residuals: its expectation given the residual, squared, is
// worth one bearing (expectation maximisation). It may be less or more than what is stated.
//
// Noise is rarely white: a tracker's error, or a hand's, is nearly the same in the next frame. How
// much of it is new in each frame is seen in the second differences of a station's own bearings,
// from which the target's motion drops out. The rest averages out more slowly, and each bearing is
// worth that much less.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "geometry/direction.h"

namespace ols::fusion {

struct BiasModelConfig {
  double stated_time_s = 1800.0;   // correlation time of a pose's error within what is stated
  double untold_time_s = 5.0;      // and of one that the station does not tell
  double memory_s = 600.0;         // what was seen longer ago counts less than 1/e
  double stated_weight = 20.0;     // seen biases that a statement is worth
  double untold_weight = 1.0;      // and that the guess is worth where nothing is stated
  double untold_over_noise = 0.5;  // that guess: sd of the bias over the sd of the noise
  double least_over_noise = 0.2;   // what is taken for zero stays zero: least sd of any bias
  double noise_weight = 20.0;      // bearings that a stated noise is worth
  double noise_memory = 500.0;     // bearings in whose mean the noise is judged
  double least_noise = 0.1;        // bounds of the noise over what is stated [variances]
  double greatest_noise = 100.0;
  double clock_time_s = 5.0;     // correlation time of a clock's error
  double colour_time_s = 0.3;    // and of the noise that is not new in each frame: between that
                                 // and the bias, which is slow
  double colour_memory = 500.0;  // second differences in whose mean the share is judged
};

// The prior of one station's bias as seen towards a target, and of what makes it: a small rotation
// of the station (about east, north, up: two tilts alike and a heading), and where its place is
// told apart, an error of that.
struct BiasPrior {
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // [rad^2] stationary, tangent plane
  Eigen::Array3d rotation = Eigen::Array3d::Zero();      // [rad^2] stationary variances
  Eigen::Array3d time_s = Eigen::Array3d::Ones();        // its correlation times
  bool position_states = false;                          // otherwise the rotation contains it
  Eigen::Array3d place_m2 = Eigen::Array3d::Zero();      // stationary variances: east, north, up
  double place_time_s = 1.0;                             // its correlation time
  // Of the rotation's variances, the share that the residuals have shown beyond what was stated or
  // guessed.
  Eigen::Array3d shown = Eigen::Array3d::Zero();
};

// A station's bias [rad], cross-elevation and elevation, each with its variance after and before.
struct BiasEstimate {
  Eigen::Array2d value = Eigen::Array2d::Zero();
  Eigen::Array2d variance = Eigen::Array2d::Zero();
  Eigen::Array2d prior = Eigen::Array2d::Zero();
};

class BiasModel {
 public:
  explicit BiasModel(const BiasModelConfig& config = {}) : config_(config) {}
  // Evidence on top of what is known: it reads through to `known`, which has to outlive it, and
  // keeps what bearings show to itself. known.learn() takes it over.
  static BiasModel evidence_on(const BiasModel& known);
  void learn(const BiasModel& evidence);

  // Stays of the sight line itself: calibration, and the station's place seen from the range.
  BiasPrior prior(const std::string& station, const LineOfSight& sight, double range_m,
                  bool position_states = false) const;
  // The same, added to what a ray states, for estimators without bias states [rad^2].
  Eigen::Matrix2d undeclared(const std::string& station, const LineOfSight& sight) const;
  // A bias as the filter has it and what its prior was, over dt_s since it was told last.
  void observe(const std::string& station, const LineOfSight& sight, const BiasEstimate& bias,
               double dt_s, double range_m);
  // What the residual of a bearing shows of the noise's variance, over the one it was taken with.
  void observe_residual(const std::string& station, double ratio);
  // The variance of a station's noise over the one that it states.
  double noise_scale(const std::string& station) const;
  // A second difference of a station's bearings, squared, over what white noise of noise_scale()
  // would make.
  void observe_noise(const std::string& station, double squared_ratio);
  // How many times its stated variance a bearing counts with, when they come at this interval: 1 if
  // the noise is white.
  double inflation(const std::string& station, double interval_s) const;
  double clock_time_s() const { return config_.clock_time_s; }
  void forget(const std::string& station);
  void clear() { *this = BiasModel(config_); }

 private:
  struct Seen {
    // Of earlier biases, and of the one as it is now: that is one more, however new.
    Eigen::Array2d weight = Eigen::Array2d::Zero(), weight_now = Eigen::Array2d::Zero();
    Eigen::Array2d squared_rad2 = Eigen::Array2d::Zero(), squared_now_rad2 = Eigen::Array2d::Zero();
    Eigen::Array2d noise_rad2 = Eigen::Array2d::Zero();  // stated, of one bearing, lately
    double residuals = 0.0, noise = 0.0;                 // bearings; sum of noise over stated
    double white_share = 1.0;                            // of its noise, new in each frame
  };
  const Seen* find(const std::string& station) const;
  Seen& at(const std::string& station);
  void count(const Seen& seen, double sign);
  Eigen::Array2d learnt(const std::string& station, const Eigen::Array2d& stated_rad2,
                        const Eigen::Array2d& noise_rad2) const;

  BiasModelConfig config_;
  const BiasModel* known_ = nullptr;  // of evidence: what it is on top of
  std::map<std::string, Seen, std::less<>> stations_;
  // Over the stations that state nothing: weights, and squared biases over the noise's variance.
  Eigen::Array2d common_weight_ = Eigen::Array2d::Zero();
  Eigen::Array2d common_ratio_ = Eigen::Array2d::Zero();
};

}  // namespace ols::fusion
