// The bias and noise model of each station: the errors that it declares, and what its residuals
// show beyond them. Pure.
//
// The filter carries each station's bias (cross-elevation, elevation) as states with a prior of
// zero mean. The prior variance v is learnt here. A bias estimated as b with variance P is
// observable with the share k = 1 - P / v. Its square counts as b^2 - k P with the weight k^2. So
// it counts fully where the geometry determines the bias, and not at all where it does not. (One
// step of Fisher scoring on the marginal likelihood: Harville, 1977.)
//
// An undeclared systematic error is first assumed to be small. The biases of other stations that
// declare none, in units of their stated noise, count as evidence for it, too. The only absolute
// scale in this is the bias's correlation time, so it holds for a drone and for a meteor. A clock
// offset is learnt in the same way where its error is only guessed.
//
// The noise variance is learnt from the residuals (expectation maximisation): each bearing
// contributes the expected square of its noise, given the residual. The noise may be smaller or
// larger than stated. A station that declares no bias states one sigma for noise and bias together.
// The part that does not appear as noise is added to its assumed bias. It leaves again when the
// estimated biases turn out smaller.
//
// Noise is rarely white: the error of a tracker, or of a person, is nearly the same in the next
// frame. The white share is estimated from the second differences of a station's own bearings, in
// which the target's motion cancels. The rest averages out more slowly, so the weight of each
// bearing is reduced accordingly.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "geometry/direction.h"

namespace ols::fusion {

struct BiasModelConfig {
  double stated_time_s = 60e3;     // correlation time of a declared pose error
  double undeclared_time_s = 5.0;  // correlation time of an undeclared one
  double memory_s = 600.0;         // older evidence counts less than 1/e
  double stated_weight = 20.0;     // weight of a declared bias, in estimated biases
  double undeclared_weight = 1.0;  // weight of the assumed bias where none is declared
  // Smallest sd of a bias, over the sd of the noise. Assumed where a station declares no bias and
  // its residuals show none.
  double least_over_noise = 0.2;
  double noise_weight = 20.0;   // weight of the stated noise and its whiteness, in bearings
  double noise_memory = 500.0;  // over which the noise is averaged [bearings]
  double least_noise = 0.1;     // bounds of the noise over the stated one [variances]
  double greatest_noise = 100.0;
  double clock_time_s = 5.0;  // correlation time of a clock's error
  // Weight of a clock's stated error, in estimated offsets; 0: the stated error is not changed.
  double clock_weight = 0.0;
  double colour_time_s = 0.3;  // correlation time of coloured noise: between a frame and the slow
                               // bias
  // The same for a station that declares no bias: slower errors are in its bias.
  double undeclared_colour_time_s = 0.05;
  double colour_memory = 500.0;  // over which the white share is averaged [second differences]
};

// The prior of one station's bias in the direction of a target, and the causes of that bias: a
// small rotation of the station (about east, north, up: two equal tilts and a heading), an
// elevation error that is fixed in the camera (mounting, and where on the target it points) and,
// with position_states, an error of its position. What a camera's error adds to cross-elevation
// counts as heading: at low elevations it is the same.
struct BiasPrior {
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // [rad^2] stationary, tangent plane
  Eigen::Array3d rotation = Eigen::Array3d::Zero();      // [rad^2] stationary variances
  double camera = 0.0;  // [rad^2] stationary variance of the elevation error fixed in the camera
  double time_s = 1.0;  // correlation time of the rotation
  bool position_states = false;                      // false: the rotation contains it
  Eigen::Array3d place_m2 = Eigen::Array3d::Zero();  // stationary variances: east, north, up
  double place_time_s = 1.0;                         // correlation time of the position error
  // The share of the rotation's variances that no station declares and only residuals show.
  Eigen::Array3d empirical = Eigen::Array3d::Zero();
};

// A station's bias [rad] (cross-elevation, elevation), and each axis's posterior and prior
// variance.
struct BiasEstimate {
  Eigen::Array2d value = Eigen::Array2d::Zero();
  Eigen::Array2d variance = Eigen::Array2d::Zero();
  Eigen::Array2d prior = Eigen::Array2d::Zero();
};

class BiasModel {
 public:
  explicit BiasModel(const BiasModelConfig& config = {}) : config_(config) {}
  // A model for new evidence on top of `known`. It reads what it lacks from `known`, which must
  // outlive it, and stores the new evidence separately. known.learn() adopts that evidence.
  static BiasModel evidence_on(const BiasModel& known);
  void learn(const BiasModel& evidence);

  // Systematic error of the line of sight itself: calibration, and the station's position error
  // divided by the range.
  BiasPrior prior(const std::string& station, const LineOfSight& sight, double range_m,
                  bool position_states = false) const;
  // The variance to add to a ray's stated one, for estimators without bias states [rad^2].
  Eigen::Matrix2d undeclared(const std::string& station, const LineOfSight& sight) const;
  // A bias estimated by the filter, dt_s after its last report, with its prior.
  void observe(const std::string& station, const LineOfSight& sight, const BiasEstimate& bias,
               double dt_s, double range_m);
  // ratio: the noise variance that a bearing's residual shows, over the variance with which the
  // bearing was processed.
  void observe_residual(const std::string& station, double ratio);
  // The variance of a station's noise over the stated one.
  double noise_scale(const std::string& station) const;
  // squared_ratio: a squared second difference of a station's bearings, over its expectation for
  // white noise of noise_scale().
  void observe_noise(const std::string& station, double squared_ratio);
  // The white share: the part of a station's noise variance that is new in each bearing; above 0,
  // at most 1.
  double white_share(const std::string& station) const;
  // The upper confidence limit of the white share.
  double greatest_white_share(const std::string& station) const;
  // The factor by which to multiply a bearing's stated variance when bearings come at this
  // interval; 1 if the noise is white. declared: the station declares a bias.
  double inflation(const std::string& station, bool declared, double interval_s) const;
  double clock_time_s() const { return config_.clock_time_s; }
  // A clock offset estimated by the filter, dt_s after the last report, with its variance, its
  // prior and the variance that the station states [s^2].
  void observe_clock(const std::string& station, double value_s, double variance_s2,
                     double prior_s2, double stated_s2, double dt_s);
  // The variance of a station's clock offset over the stated one, at least 1.
  double clock_scale(const std::string& station) const;
  void forget(const std::string& station);
  void clear() { *this = BiasModel(config_); }

 private:
  struct Seen {
    // The weights of earlier biases, and of the current one.
    Eigen::Array2d weight = Eigen::Array2d::Zero(), weight_now = Eigen::Array2d::Zero();
    Eigen::Array2d squared_rad2 = Eigen::Array2d::Zero(), squared_now_rad2 = Eigen::Array2d::Zero();
    Eigen::Array2d noise_rad2 = Eigen::Array2d::Zero();   // stated, of one recent bearing
    double residuals = 0.0, noise = 0.0;                  // bearings; sum of noise over stated
    double clock_weight = 0.0, clock_now = 0.0;           // as above, of clock offsets
    double clock_squared = 0.0, clock_squared_now = 0.0;  // over the stated variance
    double differences = 0.0, white = 0.0;                // second differences; sum of their ratios
  };
  const Seen* find(const std::string& station) const;
  Seen& at(const std::string& station);
  void count(const Seen& seen, double sign);
  Eigen::Array2d learnt(const std::string& station, const Eigen::Array2d& stated_rad2,
                        const Eigen::Array2d& noise_rad2) const;

  BiasModelConfig config_;
  const BiasModel* known_ = nullptr;  // for evidence: the model below
  std::map<std::string, Seen, std::less<>> stations_;
  // Over the stations that declare nothing: weights, and squared biases over the noise variance.
  Eigen::Array2d common_weight_ = Eigen::Array2d::Zero();
  Eigen::Array2d common_ratio_ = Eigen::Array2d::Zero();
};

}  // namespace ols::fusion
