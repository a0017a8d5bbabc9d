// A block of an adjustment: either a prior, or observations that share nuisance parameters ("the
// nuisance"). A block eliminates its nuisance (Schur complement) and returns information, gradient
// and squares. An adjustment can therefore add it, leave it out and test it as a unit.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "calibration/target.h"

namespace ols::calibration {

// A block's equations at a state, in the natural units of the global parameters.
struct BlockEquations {
  // Indices of the global parameters, in the order of the rows and columns below.
  std::vector<int> columns;
  Eigen::MatrixXd information;  // J' W J, with the nuisance eliminated
  Eigen::VectorXd gradient;     // J' W v
  double squares = 0.0;         // v' W v, with the nuisance that fits the state best
  double misfit = 0.0;          // v' W v, with the nuisance of the state
  // If the global parameters change by dx, the nuisance changes by -(nuisance_step + nuisance_by
  // dx).
  Eigen::VectorXd nuisance_step;
  Eigen::MatrixXd nuisance_by;
  // The same equations, for a shift of the target as seen from the station (across, up) [rad].
  Eigen::Matrix2d shift_information = Eigen::Matrix2d::Zero();
  Eigen::Matrix<double, Eigen::Dynamic, 2> shift_by;
  Eigen::Vector2d shift_gradient = Eigen::Vector2d::Zero();
  // Residuals of the sightings [px], in the order of the block.
  std::vector<Eigen::Vector2d> residuals;
  std::vector<double> weights;  // of the sightings; below 1 for scene points that do not fit
  bool valid = true;            // false if a target is behind the camera or outside the lens model
};

class Block;
using BlockPtr = std::shared_ptr<const Block>;

class Block {
 public:
  virtual ~Block() = default;
  // The number of observations, minus that of nuisance parameters without a prior.
  virtual int degrees_of_freedom() const = 0;
  virtual Eigen::VectorXd initial(const State&) const { return Eigen::VectorXd(0); }
  // `damping`: the damping of Levenberg and Marquardt, for the nuisance.
  virtual BlockEquations equations(const State& state, std::size_t block, double damping) const = 0;
  // The heading of the block's station at which the block's first sighting points at its target.
  virtual std::optional<double> heading(const State&, std::size_t) const { return std::nullopt; }
  // The part of the block with the sightings of one station; null if there are none.
  virtual BlockPtr of_station(std::size_t) const { return nullptr; }
  // For the block of a target. sighting_count(): the number of its sightings. with_only(): the
  // block with only the sightings of these indices. without_each(): calls TakeEquations for each
  // sighting, with the block's equations without this sighting, over the same columns.
  // without_each() does not return all equations at once, because the equations for 10 000
  // sightings need 100 MB.
  virtual std::size_t sighting_count() const { return 0; }
  virtual BlockPtr with_only(const std::vector<std::size_t>&) const { return nullptr; }
  using TakeEquations = std::function<void(std::size_t sighting, const BlockEquations& without)>;
  virtual void without_each(const State&, std::size_t, const TakeEquations&) const {}
};

// The station's model at a sighting. If the sighting's pose is shared, the errors of the pose are
// added to the two shaft angles.
StationModel posed_model(const State& state, const Sighting& sighting);

struct PixelBlockConfig {
  Layout layout;
  bool robust = false;
  bool absolute = true;  // a person has stated where the target is
};
BlockPtr pixel_block(TargetPtr target, std::vector<Sighting> sightings,
                     const PixelBlockConfig& config);
// The readings of one station's inclinometer. The nuisance: the error of the inclinometer's zero.
BlockPtr level_block(const Layout& layout, std::vector<Observation> readings);
// The priors of a station's parameters, of UT1, and of a shared pose's angles.
BlockPtr station_prior_block(const Layout& layout, std::size_t station,
                             const StationMatrix& covariance);
BlockPtr ut1_prior_block(const Layout& layout, double sd_s);
BlockPtr pose_prior_block(const Layout& layout, std::size_t pose, double sd_rad);

// Eliminates the nuisance from a block's normal equations (N, b, squares). The rows of N and b are
// in the order global parameters, shift, nuisance. `columns`: number of the global parameters.
// `shift`: number of the rows for the shift, 2 or 0.
BlockEquations eliminated(const Eigen::MatrixXd& N, const Eigen::VectorXd& b, double squares,
                          Eigen::Index columns, Eigen::Index shift, double damping);

}  // namespace ols::calibration
