#include "central/estimators/paper_pairing.h"

#include <Eigen/Geometry>
#include <cmath>

namespace ols::fusion {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// All pairs that intersect; `failure` becomes the last pair's reason.
std::vector<PaperBase> bases_of(const std::vector<PaperView>& views, const PaperConfig& config,
                                Solution& failure) {
  std::vector<PaperBase> bases;
  bases.reserve(views.size() * views.size() / 2);
  for (std::size_t i = 0; i < views.size(); ++i) {
    for (std::size_t j = i + 1; j < views.size(); ++j) {
      const PaperPoint point = paper_two_view(views[i], views[j], config);
      if (point.solution != Solution::kOk) {
        failure = point.solution;
        continue;
      }
      bases.push_back(
          {i, j, point.position_ecef, {views[i].centre_ecef, views[j].centre_ecef}, 0.0});
    }
  }
  return bases;
}

Vector3d unweighted_centroid(const std::vector<PaperBase>& bases) {
  Vector3d offset = Vector3d::Zero();
  for (const PaperBase& base : bases) offset += base.point - bases.front().point;
  return bases.front().point + offset / static_cast<double>(bases.size());
}

// Gradient of normal_component(baseline, target) by the target: it is the sine of the angle between
// the baseline a and the line r to the target. Zero where r runs along the baseline.
Vector3d gradient_of_normal_component(const Baseline& baseline, const Vector3d& target) {
  const Vector3d a = (baseline.second - baseline.first).normalized();
  const Vector3d to_target = target - 0.5 * (baseline.first + baseline.second);
  const double distance_m = to_target.norm();
  const Vector3d r = to_target / distance_m;
  const double cosine = a.dot(r);
  const Vector3d across = a - cosine * r;
  const double sine = across.norm();
  if (!(distance_m > 0.0) || !(sine > 0.0)) return Vector3d::Zero();
  return -cosine / (distance_m * sine) * across;
}

// Algorithm 1, lines 5 to 8; T0 is its T' of line 4.
void weigh_pairs(const Vector3d& T0, PaperPairing& pairing) {
  double sum = 0.0;
  Vector3d offset = Vector3d::Zero();
  for (PaperBase& base : pairing.bases) {
    base.share = std::exp(normal_component(base.baseline, T0));  // line 6
    sum += base.share;
    offset += base.share * (base.point - T0);
  }
  pairing.position_ecef = T0 + offset / sum;  // line 8
  for (PaperBase& base : pairing.bases) {
    base.share /= sum;
    pairing.by_centroid += base.share * (base.point - pairing.position_ecef) *
                           gradient_of_normal_component(base.baseline, T0).transpose();
  }
}

void choose_best_baseline(const Vector3d& T0, PaperPairing& pairing) {
  std::vector<Baseline> baselines;
  for (const PaperBase& base : pairing.bases) baselines.push_back(base.baseline);
  PaperBase& best = pairing.bases[best_baseline(baselines, T0)];
  best.share = 1.0;
  pairing.position_ecef = best.point;
}

// A view's direction relative to the baseline m: theta is its angle from m, and e is where it
// points across m.
struct AboutBaseline {
  double cosine, sine;  // of theta
  Vector3d e;           // unit, across m

  AboutBaseline(const Vector3d& m, const Vector3d& direction)
      : cosine(m.dot(direction)), e(direction - cosine * m) {
    sine = e.norm();
    e /= sine;
  }
  // Gradients of both angles by the direction.
  Vector3d d_theta(const Vector3d& m) const { return cosine * e - sine * m; }
  Vector3d d_about(const Vector3d& m) const { return m.cross(e) / sine; }
};

// beta1 / alpha of paper_two_view().
double share_of_turn(const PaperView& first, const PaperView& second, const PaperConfig& config) {
  const double belief = config.by_belief ? first.belief + second.belief : 0.0;
  return belief > 0.0 ? second.belief / belief : 0.5;
}

struct PairDerivative {
  Matrix3d by_first, by_second;
};

// Derivatives of the intersection W of two views. Both rays are turned into a common plane, whose
// angle about the baseline is the mean of the views' angles, weighted by their beliefs. In that
// plane, W is at the distance s = L sin(theta2) / sin(theta2 - theta1) from the first centre, and t
// = L sin(theta1) / sin(theta2 - theta1) from the second.
PairDerivative derivative_of(const PaperView& first, const PaperView& second, const Vector3d& W,
                             const PaperConfig& config) {
  const Vector3d m = (second.centre_ecef - first.centre_ecef).normalized();
  const AboutBaseline one(m, first.direction_ecef), two(m, second.direction_ecef);
  const double s = (W - first.centre_ecef).norm(), t = (W - second.centre_ecef).norm();
  const Vector3d u = (W - first.centre_ecef) / s;
  const Vector3d e = (u - one.cosine * m) / one.sine;
  const double cosine = one.cosine * two.cosine + one.sine * two.sine;  // of theta2 - theta1
  const double sine = two.sine * one.cosine - two.cosine * one.sine;
  const Vector3d by_theta1 = s * (cosine / sine * u + one.cosine * e - one.sine * m);
  const Vector3d by_theta2 = -t / sine * u;
  const Vector3d by_plane = s * one.sine * m.cross(e);
  const double turned = share_of_turn(first, second, config);
  return {by_theta1 * one.d_theta(m).transpose() +
              (1.0 - turned) * by_plane * one.d_about(m).transpose(),
          by_theta2 * two.d_theta(m).transpose() + turned * by_plane * two.d_about(m).transpose()};
}

}  // namespace

PaperPairing pair_views(const std::vector<PaperView>& views, const PaperConfig& config) {
  PaperPairing pairing;
  pairing.bases = bases_of(views, config, pairing.solution);
  if (pairing.bases.empty()) return pairing;
  pairing.solution = Solution::kOk;
  const Vector3d T0 = unweighted_centroid(pairing.bases);  // T' of Algorithm 1, line 4
  switch (config.pairs) {
    case PaperPairs::kAlgorithm1:
      weigh_pairs(T0, pairing);
      break;
    case PaperPairs::kCentroid:
      pairing.position_ecef = T0;
      for (PaperBase& base : pairing.bases)
        base.share = 1.0 / static_cast<double>(pairing.bases.size());
      break;
    case PaperPairs::kBestBaseline:
      choose_best_baseline(T0, pairing);
      break;
  }
  return pairing;
}

std::vector<Matrix3d> derivatives_by_direction(const std::vector<PaperView>& views,
                                               const PaperPairing& pairing,
                                               const PaperConfig& config) {
  std::vector<Matrix3d> derivatives(views.size(), Matrix3d::Zero());
  const Matrix3d by_centroid = pairing.by_centroid / static_cast<double>(pairing.bases.size());
  for (const PaperBase& base : pairing.bases) {
    if (base.share == 0.0) continue;
    const PairDerivative pair =
        derivative_of(views[base.first], views[base.second], base.point, config);
    const Matrix3d by_point = base.share * Matrix3d::Identity() + by_centroid;
    derivatives[base.first] += by_point * pair.by_first;
    derivatives[base.second] += by_point * pair.by_second;
  }
  return derivatives;
}

}  // namespace ols::fusion
