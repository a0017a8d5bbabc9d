// The least-squares adjustment of a network. Solves damped normal equations (Levenberg and
// Marquardt) for the global parameters; the nuisance parameters of each block are eliminated.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "calibration/groups.h"

namespace ols::calibration {

struct Fit {
  std::vector<bool> kept;  // for each group
  State state;
  std::vector<BlockEquations> equations;  // of all blocks at the state, including rejected groups
  Eigen::MatrixXd covariance;  // of the global parameters; 0 for a value that is known exactly
  double misfit = 0.0;         // of the kept groups and the priors
  bool converged = false;
};

class Adjustment {
 public:
  explicit Adjustment(Network network);

  const Network& network() const { return network_; }
  const std::vector<Group>& groups() const { return network_.groups; }
  // The state in which all parameters have their prior values, except these headings.
  State start(const std::vector<double>& headings_rad) const;
  Fit fit(State start, const std::vector<bool>& kept) const;
  // Predicts the covariance of a station's parameters after all groups have been sighted, assuming
  // that the true parameters equal the priors. Does not use the observations' pixels. The result is
  // infinite if a target could not be seen.
  StationMatrix planned_covariance(std::size_t station) const;
  // A group's equations: the sum of its blocks' equations, over all parameters on which its blocks
  // depend.
  BlockEquations equations(const Fit& fit, std::size_t group) const;

 private:
  // Normal equations in units of `scale_`.
  struct Normal {
    std::vector<BlockEquations> equations;
    Eigen::MatrixXd N;
    Eigen::VectorXd b;
    double misfit = 0.0;
    bool valid = true;
  };
  std::vector<bool> used_blocks(const std::vector<bool>& kept) const;
  Normal normal(const State& state, const std::vector<bool>& used, double damping) const;
  State stepped(const State& state, const Normal& normal, const std::vector<bool>& used,
                const Eigen::VectorXd& step) const;
  void fit_rejected(Fit& fit, const std::vector<bool>& used) const;

  Network network_;
  Eigen::VectorXd scale_;  // of the global parameters; 0 for a value that is known exactly
};

}  // namespace ols::calibration
