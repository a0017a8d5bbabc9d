// The model of each station's bias and noise: the errors that the station declares, and the further
// errors that its residuals show. Pure.
//
// The filter has states for each station's bias (cross-elevation, elevation), with a prior of zero
// mean. This class learns the prior variance v. If the filter estimates the bias as b with variance
// P, the share k = 1 - P / v is observable. The estimate contributes b^2 - k P to v, with the
// weight k^2. The weight is 1 if the geometry determines the bias, and 0 if it does not. (One step
// of Fisher scoring on the marginal likelihood: Harville, 1977.)
//
// An undeclared bias is first assumed to be small. The biases of other stations that declare none
// are also evidence for its size; each bias is taken in units of its station's stated noise. Except
// for the correlation time of the bias, the model contains no absolute scale, and therefore suits a
// drone as well as a meteor. If a station's clock error is only a guess, its clock offset is learnt
// in the same way.
//
// The noise variance is learnt from the residuals (expectation maximisation): each bearing
// contributes the expected square of its noise, given its residual. The actual noise may be smaller
// or larger than stated. A station that declares no bias states one sigma for noise and bias
// together. The part of this sigma that does not appear as noise is added to the assumed bias. It
// is removed again if the estimated biases turn out smaller.
//
// Noise is rarely white: a tracker's or a person's error is nearly the same in the next frame. The
// white share of the noise is estimated from the second differences of a station's bearings, in
// which the target's motion cancels. The coloured share averages out more slowly. Each bearing
// therefore gets a smaller weight.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_map>

#include "geometry/direction.h"

namespace ols::fusion {

struct BiasModelConfig {
  double stated_time_s = 60e3;     // correlation time of a declared pose error
  double undeclared_time_s = 5.0;  // correlation time of an undeclared pose error
  double memory_s = 600.0;         // the weight of evidence falls to 1/e in this time
  double stated_weight = 20.0;     // weight of a declared bias, as a number of estimated biases
  double undeclared_weight = 1.0;  // the same for the bias assumed if none is declared
  // Smallest sd of a bias, relative to the sd of the noise. It applies if a station declares no
  // bias and its residuals show none.
  double least_over_noise = 0.2;
  // Weight of the prior assumption (noise as stated, and white), as a number of bearings.
  double noise_weight = 20.0;
  double noise_memory = 500.0;  // number of bearings over which the noise is averaged
  double least_noise = 0.1;     // bounds of the ratio of actual to stated noise variance
  double greatest_noise = 100.0;
  double clock_time_s = 5.0;  // correlation time of a clock error
  // Weight of a clock's stated error, as a number of estimated offsets. 0: the stated error is
  // used, and no clock offset is learnt.
  double clock_weight = 0.0;
  // Correlation time of coloured noise. It is longer than a frame interval and shorter than the
  // correlation time of the bias.
  double colour_time_s = 0.3;
  // The same for a station that declares no bias: its slower errors are part of its bias.
  double undeclared_colour_time_s = 0.05;
  // Number of second differences over which the white share is averaged.
  double colour_memory = 500.0;
};

// The prior of one station's bias in the direction of a target, and the priors of its causes. The
// first cause is a small rotation of the station: a tilt about east and a tilt about north, with
// equal variances, and a heading error about up. The second is an elevation error that is fixed in
// the camera, from its mounting. With position_states, the third is an error of the station's
// position, together with the aim (LineOfSight::aim_sd_rad). These two share their states, because
// both displace the line of sight at the target by a number of metres, not by an angle. A
// cross-elevation error of the camera is treated as a heading error, because at low elevations the
// two are the same.
struct BiasPrior {
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // [rad^2] on the tangent plane
  Eigen::Array3d rotation = Eigen::Array3d::Zero();      // [rad^2] variances
  double camera = 0.0;           // [rad^2] variance of the elevation error fixed in the camera
  double time_s = 1.0;           // correlation time of the rotation
  bool position_states = false;  // if false, the rotation includes position error and aim
  // Covariance of position error and aim: east, north, up.
  Eigen::Matrix3d place_m2 = Eigen::Matrix3d::Zero();
  double place_time_s = 1.0;  // their correlation time
  // The share (0..1) of each variance of the rotation that the station does not declare: only
  // residuals show it.
  Eigen::Array3d empirical = Eigen::Array3d::Zero();
};

// The covariance of position error and aim (BiasPrior::place_m2), for a target at range_m.
Eigen::Matrix3d place_covariance(const LineOfSight& sight, double range_m);

// The filter's estimate of a station's bias [rad] (cross-elevation, elevation), with its posterior
// and prior variances [rad^2].
struct BiasEstimate {
  Eigen::Array2d value = Eigen::Array2d::Zero();
  Eigen::Array2d variance = Eigen::Array2d::Zero();
  Eigen::Array2d prior = Eigen::Array2d::Zero();
};

class BiasModel {
 public:
  explicit BiasModel(const BiasModelConfig& config = {}) : config_(config) {}
  // A model that stores new evidence separately, and reads everything else from `known`. `known`
  // must outlive it. known.learn() adopts the evidence.
  static BiasModel evidence_on(const BiasModel& known);
  void learn(const BiasModel& evidence);

  // The prior of the systematic error of a line of sight, from its stated errors and from what has
  // been learnt about the station.
  BiasPrior prior(const std::string& station, const LineOfSight& sight, double range_m,
                  bool position_states = false) const;
  // The covariance [rad^2] of the undeclared bias. Estimators without bias states add it to a ray's
  // stated systematic covariance.
  Eigen::Matrix2d undeclared(const std::string& station, const LineOfSight& sight) const;
  // Takes a bias that the filter has estimated. dt_s: time since the station's previous estimate.
  void observe(const std::string& station, const LineOfSight& sight, const BiasEstimate& bias,
               double dt_s, double range_m);
  // Takes the noise variance that a bearing's residual shows, divided by the assumed variance.
  void observe_residual(const std::string& station, double ratio);
  // The ratio of a station's actual to its stated noise variance.
  double noise_scale(const std::string& station) const;
  // Takes the square of a second difference of a station's bearings, divided by its expected value
  // for white noise of noise_scale().
  void observe_noise(const std::string& station, double squared_ratio);
  // The white share: the part of a station's noise variance that is independent in each bearing;
  // above 0, at most 1.
  double white_share(const std::string& station) const;
  // The upper 1-sigma confidence limit of the white share.
  double greatest_white_share(const std::string& station) const;
  // The factor by which to multiply a bearing's stated variance if bearings arrive at this
  // interval; 1 if the noise is white. declared: the station declares a bias.
  double inflation(const std::string& station, bool declared, double interval_s) const;
  double clock_time_s() const { return config_.clock_time_s; }
  // Takes a clock offset that the filter has estimated, and three variances [s^2]: of the estimate,
  // of its prior, and as the station states it. dt_s: time since the station's previous estimate.
  void observe_clock(const std::string& station, double value_s, double variance_s2,
                     double prior_s2, double stated_s2, double dt_s);
  // The ratio of actual to stated variance of a station's clock offset, at least 1.
  double clock_scale(const std::string& station) const;
  void forget(const std::string& station);
  void clear() { *this = BiasModel(config_); }

 private:
  struct Seen {
    // The weights of earlier bias estimates, and of the current one.
    Eigen::Array2d weight = Eigen::Array2d::Zero(), weight_now = Eigen::Array2d::Zero();
    Eigen::Array2d squared_rad2 = Eigen::Array2d::Zero(), squared_now_rad2 = Eigen::Array2d::Zero();
    Eigen::Array2d noise_rad2 = Eigen::Array2d::Zero();  // stated noise of one recent bearing
    // Number of bearings; sum of actual over stated noise variance.
    double residuals = 0.0, noise = 0.0;
    double clock_weight = 0.0, clock_now = 0.0;           // the same for clock offsets
    double clock_squared = 0.0, clock_squared_now = 0.0;  // relative to the stated variance
    double differences = 0.0, white = 0.0;  // number of second differences; sum of their ratios
  };
  const Seen* find(const std::string& station) const;
  Seen& at(const std::string& station);
  void count(const Seen& seen, double sign);
  Eigen::Array2d learnt(const std::string& station, const Eigen::Array2d& stated_rad2,
                        const Eigen::Array2d& noise_rad2) const;

  BiasModelConfig config_;
  const BiasModel* known_ = nullptr;  // the model on which this one builds, if it holds evidence
  std::unordered_map<std::string, Seen> stations_;
  // Sums over the stations that declare no bias: of the weights, and of the squared biases relative
  // to the noise variance.
  Eigen::Array2d common_weight_ = Eigen::Array2d::Zero();
  Eigen::Array2d common_ratio_ = Eigen::Array2d::Zero();
};

}  // namespace ols::fusion
