// A block of an adjustment: observations that share a nuisance, or a prior. It eliminates its
// nuisance (Schur complement) and returns information, gradient and squares. A block can therefore
// be added, left out and tested as a unit.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "calibration/target.h"

namespace ols::calibration {

// At a state, in the natural units of the globals.
struct BlockEquations {
  std::vector<int> columns;     // indices of the globals; the rows below belong to them
  Eigen::MatrixXd information;  // J' W J, nuisance eliminated
  Eigen::VectorXd gradient;     // J' W v
  double squares = 0.0;         // v' W v, with the nuisance that fits the state best
  double misfit = 0.0;          // v' W v, with the nuisance of the state
  // The change of the nuisance for a change dx of the globals: -(nuisance_step + nuisance_by dx).
  Eigen::VectorXd nuisance_step;
  Eigen::MatrixXd nuisance_by;
  // The same for a shift of the target, seen from the station: across and up [rad].
  Eigen::Matrix2d shift_information = Eigen::Matrix2d::Zero();
  Eigen::Matrix<double, Eigen::Dynamic, 2> shift_by;
  Eigen::Vector2d shift_gradient = Eigen::Vector2d::Zero();
  // Residuals of the sightings [px], in the order of the block.
  std::vector<Eigen::Vector2d> residuals;
  std::vector<double> weights;  // below 1: a scene point that a robust weight reduces
  bool valid = true;            // false: a target is behind the camera or outside the lens model
};

class Block;
using BlockPtr = std::shared_ptr<const Block>;

class Block {
 public:
  virtual ~Block() = default;
  virtual int degrees_of_freedom() const = 0;  // a nuisance without a prior reduces them
  virtual Eigen::VectorXd initial(const State&) const { return Eigen::VectorXd(0); }
  // `damping`: of Levenberg and Marquardt, for the nuisance.
  virtual BlockEquations equations(const State& state, std::size_t block, double damping) const = 0;
  // The heading of the block's station at which its first sighting hits its target.
  virtual std::optional<double> heading(const State&, std::size_t) const { return std::nullopt; }
  // The block with the sightings of one station only; null if it has none.
  virtual BlockPtr of_station(std::size_t) const { return nullptr; }
  // For a target's block: the number of its sightings; the block with some of its sightings, by
  // index; the block's equations without each one of its sightings, over the same columns.
  virtual std::size_t sighting_count() const { return 0; }
  virtual BlockPtr with_only(const std::vector<std::size_t>&) const { return nullptr; }
  virtual std::vector<BlockEquations> without_each(const State&, std::size_t) const { return {}; }
};

// The station's model at a sighting: the errors of a shared pose are turns of the two shafts.
StationModel posed_model(const State& state, const Sighting& sighting);

struct PixelBlockConfig {
  Layout layout;
  bool robust = false;
  bool absolute = true;  // a person has stated where its target is
};
BlockPtr pixel_block(TargetPtr target, std::vector<Sighting> sightings,
                     const PixelBlockConfig& config);
// The readings of one station's inclinometer; its zero is the nuisance.
BlockPtr level_block(const Layout& layout, std::vector<Observation> readings);
// The priors of a station's parameters, of UT1, and of a shared pose's angles.
BlockPtr station_prior_block(const Layout& layout, std::size_t station,
                             const StationMatrix& covariance);
BlockPtr ut1_prior_block(const Layout& layout, double sd_s);
BlockPtr pose_prior_block(const Layout& layout, std::size_t pose, double sd_rad);

// Eliminates the nuisance, the last rows, from a block's normal equations N, b and squares over
// (columns, shift, nuisance). `shift` is 2 or 0.
BlockEquations eliminated(const Eigen::MatrixXd& N, const Eigen::VectorXd& b, double squares,
                          Eigen::Index columns, Eigen::Index shift, double damping);

}  // namespace ols::calibration
