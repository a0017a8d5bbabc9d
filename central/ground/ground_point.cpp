#include "central/ground/ground_point.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "central/ground/above_ground.h"
#include "central/ground/visibility.h"
#include "central/measurement/ray.h"
#include "geometry/chi_square.h"
#include "geometry/wgs84.h"
#include "land/refraction.h"

namespace ols::fusion {
namespace {

constexpr double kFar = 6.0;  // sigmas; no target is farther from the ground

// The line at one range.
struct Node {
  double range_m = 0.0;
  Eigen::Vector3d p_ecef = Eigen::Vector3d::Zero();
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  // ECEF, unit
  double above_m = 0.0;  // height of the line above the middle of an object that stands there
  double clear_m = 0.0;  // height of the line above the top of the land
  double top_sd_m = 0.0;
  double ground_m2 = 0.0;  // variance of that middle's height
  double line_m2 = 0.0;    // variance of the line's height
  double weight = 0.0;

  double variance_m2() const { return ground_m2 + line_m2; }
  double sigmas() const { return above_m / std::sqrt(variance_m2()); }
};

struct Errors {
  double white_rad2 = 0.0, all_rad2 = 0.0;  // of the elevation
  double origin_m2 = 0.0;                   // of the camera's height
};

std::optional<Node> node_at(const land::Surface& surface, const LineOfSight& sight,
                            const Eigen::Vector3d& along, const Errors& errors, double range_m) {
  Node node{.range_m = range_m};
  const Eigen::Vector3d straight = sight.origin_ecef + range_m * along;
  const Geodetic place = geodetic_from_ecef(straight);
  const auto ground = surface.ground(place.latitude_rad, place.longitude_rad);
  const auto top = surface.top(place.latitude_rad, place.longitude_rad);
  if (!ground || !top) return std::nullopt;
  const double bent_m = land::refraction_slope(land::kRefraction, range_m) * range_m;
  node.up = R_ecef_enu(place).col(2);
  node.p_ecef = straight - bent_m * node.up;
  node.above_m = place.height_m - bent_m - ground->height_m - kMiddle_m;
  node.clear_m = place.height_m - bent_m - top->height_m;
  node.top_sd_m = top->sd_m;
  node.ground_m2 = ground->sd_m * ground->sd_m + kMiddleSd_m * kMiddleSd_m;
  node.line_m2 = range_m * range_m * errors.all_rad2 + errors.origin_m2;
  return node;
}

constexpr double kShortest_m = 0.5;

// Long steps far from the ground; several per sigma near it.
double step_m(const Node& node, double slope) {
  constexpr double kOfASigma = 0.25;
  const double longest_m = 5.0 + 0.004 * node.range_m;
  const double sd_m = std::sqrt(node.variance_m2());
  const double away_m = std::abs(node.above_m) - kFar * sd_m;
  if (away_m > 0.0) return std::max(longest_m, away_m / 2.0);
  return std::clamp(kOfASigma * sd_m / std::max(1e-6, std::abs(slope)), kShortest_m, longest_m);
}

// Whether the height changes so much between two nodes that another one is needed in between.
bool is_gap(const Node& before, const Node& after) {
  const bool is_far = std::min(before.sigmas(), after.sigmas()) > kFar;
  const double sd_m = std::sqrt(after.variance_m2());
  return !is_far && std::abs(after.above_m - before.above_m) > sd_m;
}

// Nodes along the line, until it is so far below the ground that nothing behind can be seen. Empty
// if it never gets there, or where the land is unknown.
std::vector<Node> walk(const land::Surface& surface, const LineOfSight& sight, const Errors& errors,
                       double max_range_m) {
  const Eigen::Vector3d along = direction_ecef(sight);
  std::vector<Node> nodes;
  for (double range_m = 5.0; range_m < max_range_m;) {
    const auto node = node_at(surface, sight, along, errors, range_m);
    if (!node) return {};
    double slope = 0.0;
    if (!nodes.empty()) {
      const double gap_m = range_m - nodes.back().range_m;
      if (gap_m > kShortest_m && is_gap(nodes.back(), *node)) {
        range_m -= gap_m / 2.0;
        continue;
      }
      slope = (node->above_m - nodes.back().above_m) / gap_m;
      if (gap_m <= kShortest_m && nodes.back().above_m > 0.0 && node->above_m < 0.0) {
        Node wall = nodes.back();  // the line ends at a wall, whatever the errors are
        wall.above_m = 0.0;
        wall.range_m += gap_m / 2.0;
        nodes.push_back(wall);
      }
    }
    nodes.push_back(*node);
    if (node->sigmas() < -kFar) return nodes;
    range_m += step_m(*node, slope);
  }
  return !nodes.empty() && nodes.back().sigmas() < -3.0 ? nodes : std::vector<Node>{};
}

// The line's clearance above land tops of one sigma: the lower convex hull over range, nearest
// first. It gives the least clearance of a tilted line in few steps.
class Clearance {
 public:
  void add(const Node& node) {
    const Eigen::Vector2d p(node.range_m, node.clear_m);
    const auto is_above = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
      const Eigen::Vector2d along = b - a, on = p - a;
      return along.x() * on.y() - along.y() * on.x() <= 0.0;
    };
    while (hull_.size() >= 2 && is_above(hull_[hull_.size() - 2], hull_.back())) hull_.pop_back();
    hull_.push_back(p);
  }

  // The least clearance above a line that rises by `rise` per metre of range.
  double least_m(double rise) const {
    std::size_t low = 0, high = hull_.size() - 1;
    while (low < high) {
      const std::size_t middle = (low + high) / 2;
      const Eigen::Vector2d along = hull_[middle + 1] - hull_[middle];
      if (along.y() < rise * along.x()) {
        low = middle + 1;
      } else {
        high = middle;
      }
    }
    return hull_[low].y() - rise * hull_[low].x();
  }

 private:
  std::vector<Eigen::Vector2d> hull_;
};
using Clearances = std::map<double, Clearance>;  // by the 1-sigma of the tops [m]

// The probability that nothing nearer hides a target at this node; never zero. If a target is
// there, the height between line and ground is an error: of the line and of the ground, in
// proportion to their variances. The line's part is an angle; the ground's part is the same at all
// ranges.
double seen(const Clearances& nearer, const Node& target) {
  constexpr double kLeast = 1e-3;
  const double of_line_m = target.above_m * target.line_m2 / target.variance_m2();
  double least = 0.0;
  for (const auto& [sd_m, clearance] : nearer) {
    const double off_m = target.above_m - of_line_m;
    least = std::min(least, (clearance.least_m(of_line_m / target.range_m) - off_m) / sd_m);
  }
  return std::max(kLeast, 2.0 * normal_level(-least));
}

void weigh(std::vector<Node>& nodes) {
  constexpr double kLeastSd_m = 0.1;
  double sum = 0.0;
  Clearances nearer;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (i > 0) nearer[std::max(kLeastSd_m, nodes[i - 1].top_sd_m)].add(nodes[i - 1]);
    Node& node = nodes[i];
    const double sigmas = node.sigmas();
    if (std::abs(sigmas) > kFar) continue;
    const double before_m = i == 0 ? node.range_m : nodes[i - 1].range_m;
    const double after_m = i + 1 == nodes.size() ? node.range_m : nodes[i + 1].range_m;
    node.weight = (after_m - before_m) / 2.0 * node.range_m / std::sqrt(node.variance_m2()) *
                  std::exp(-sigmas * sigmas / 2.0) * seen(nearer, node);
    sum += node.weight;
  }
  for (Node& node : nodes) node.weight /= sum;
}

// Where an object at this range is, from the heights of line and ground.
Eigen::Vector3d place_of(const Node& node) {
  return node.p_ecef - node.line_m2 / node.variance_m2() * node.above_m * node.up;
}

// Adds the covariances of the mixture of these nodes about its mean; returns the variance of the
// range [m^2].
double add_spread(const std::vector<Node>& nodes, const LineOfSight& sight, const Errors& errors,
                  GroundPoint& point) {
  const Eigen::Vector3d across = ray_frame(sight).tangent.col(0);
  const Eigen::Matrix3d sideways = across * across.transpose();
  const double white_across = sight.covariance_white(0, 0);
  const double all_across = white_across + sight.covariance_systematic(0, 0);
  double along_m2 = 0.0;
  for (const Node& node : nodes) {
    if (node.weight == 0.0) continue;
    const double squared_m2 = node.range_m * node.range_m;
    const Eigen::Vector3d off = place_of(node) - point.p_ecef;
    const Eigen::Matrix3d of_height = off * off.transpose() + node.ground_m2 * node.line_m2 /
                                                                  node.variance_m2() * node.up *
                                                                  node.up.transpose();
    const double white = squared_m2 * errors.white_rad2 / node.variance_m2();
    point.covariance_ecef += node.weight * (of_height + (squared_m2 * all_across) * sideways);
    point.covariance_white_ecef +=
        node.weight * (white * of_height + squared_m2 * white_across * sideways);
    along_m2 += node.weight * std::pow(node.range_m - point.range_m, 2);
  }
  point.covariance_ecef +=
      sight.origin_sd_enu_m.head<2>().squaredNorm() / 2.0 * Eigen::Matrix3d::Identity();
  return along_m2;
}

}  // namespace

std::optional<GroundPoint> ground_point(const land::Surface& surface, const LineOfSight& sight,
                                        const GroundPointConfig& config) {
  const double origin_m = sight.origin_sd_enu_m.z();
  const Errors errors{sight.covariance_white(1, 1),
                      sight.covariance_white(1, 1) + sight.covariance_systematic(1, 1),
                      origin_m * origin_m};
  std::vector<Node> nodes = walk(surface, sight, errors, config.max_range_m);
  if (nodes.empty()) return std::nullopt;
  weigh(nodes);
  GroundPoint point{Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero()};
  for (const Node& node : nodes) {
    if (node.weight == 0.0) continue;
    point.p_ecef += node.weight * place_of(node);
    point.range_m += node.weight * node.range_m;
  }
  if (!point.p_ecef.allFinite() || point.range_m == 0.0) return std::nullopt;
  const double along_m2 = add_spread(nodes, sight, errors, point);
  if (std::sqrt(along_m2) > config.range_sd_limit * point.range_m) return std::nullopt;
  return point;
}

}  // namespace ols::fusion
