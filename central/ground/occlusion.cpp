#include "central/ground/occlusion.h"

#include <Eigen/Cholesky>
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "geometry/angles.h"
#include "land/refraction.h"

namespace ols::fusion {
namespace {

// Three for the position, one for the land's height, one for the places of its outlines.
constexpr int kDimensions = 5, kSamples = 64, kFirstLook = 8;
constexpr double kOutlineSd_m = 1.0;  // of buildings: they are mapped to a metre or two
using Samples = Eigen::Matrix<double, kDimensions, kSamples>;

// Standard normal, in pairs of opposite signs, each dimension with a variance of 1.
Samples draw_samples() {
  Samples samples;
  std::mt19937_64 generator(42);
  std::normal_distribution<double> normal;
  for (int k = 0; k < kSamples; k += 2) {
    for (int d = 0; d < kDimensions; ++d) samples(d, k) = normal(generator);
    samples.col(k + 1) = -samples.col(k);
  }
  const auto sd = (samples.array().square().rowwise().mean()).sqrt().eval();
  return samples.array().colwise() / sd;
}

struct Look {  // of one sample at one instant
  AzimuthElevation direction;
  double above_rad = 0.0;  // above the horizon in front of it; negative: hidden
};

// The path as seen from one camera: a row for each instant, a column for each sample.
class Looks {
 public:
  Looks(LandHorizon& horizon, const Obstacles& obstacles, std::span<const Position> path)
      : horizon_(horizon),
        obstacles_(obstacles),
        path_(path),
        looks_(path.size() * kSamples),
        roots_(path.size()) {
    const Eigen::Matrix3d R_enu_ecef = horizon.frame().R_ecef_enu().transpose();
    for (std::size_t i = 0; i < path.size(); ++i) {
      const Eigen::Matrix3d P = R_enu_ecef * path[i].covariance_ecef * R_enu_ecef.transpose();
      const Eigen::LLT<Eigen::Matrix3d> root(P + 1e-9 * Eigen::Matrix3d::Identity());
      roots_[i] = {horizon.frame().to_enu(path[i].p_ecef), root.matrixL()};
      crests_m_.push_back(crest_at(i));
    }
  }

  void look(int from, int to) {
    for (std::size_t i = 0; i < path_.size(); ++i) {
      for (int k = from; k < to; ++k) looks_[i * kSamples + index(k)] = look_at(i, k, crests_m_[i]);
    }
  }
  const Look& at(std::size_t instant, int sample) const {
    return looks_[instant * kSamples + index(sample)];
  }
  double hidden(std::size_t instant, int samples = kSamples) const {
    int count = 0;
    for (int k = 0; k < samples; ++k) count += at(instant, k).above_rad < 0.0 ? 1 : 0;
    return static_cast<double>(count) / samples;
  }
  std::size_t size() const { return path_.size(); }

 private:
  static constexpr double kNearest_m = 40.0;
  static constexpr double kJustHidden_rad = 1e-4;

  struct Root {
    Eigen::Vector3d mean_enu;
    Eigen::Matrix3d root;
  };
  static std::size_t index(int sample) { return static_cast<std::size_t>(sample); }

  std::optional<land::Skyline> highest_before(double azimuth_rad, double distance_m) const {
    const auto land = horizon_.highest_before(azimuth_rad, distance_m);
    const land::SeenSkyline* const seen = obstacles_.seen;
    return land && seen != nullptr ? seen->hiding(*land, azimuth_rad, distance_m) : land;
  }

  static double apparent_elevation(const Eigen::Vector3d& enu) {
    const double distance_m = std::max(1.0, enu.head<2>().norm());
    return std::atan(enu.z() / distance_m + land::refraction_slope(land::kRefraction, distance_m));
  }

  // The distance of the nearest land that may hide the mean path if the model is wrong by three
  // sigmas: in height, or in the place of an outline. Over nearer land whoever set up the tripod
  // has looked.
  double crest_at(std::size_t instant) const {
    constexpr double kSigmas = 3.0, kNarrower = 0.6;
    const Eigen::Vector3d& enu = roots_[instant].mean_enu;
    const double azimuth_rad = std::atan2(enu.x(), enu.y()), distance_m = enu.head<2>().norm();
    const double elevation_rad = apparent_elevation(enu);
    for (double m = kNearest_m / kNarrower; m < distance_m; m /= kNarrower) {
      for (const double beside_m : {0.0, -kSigmas * kOutlineSd_m, kSigmas * kOutlineSd_m}) {
        const auto crest = horizon_.highest_before(azimuth_rad + beside_m / m, m);
        if (crest && crest->distance_m > kNearest_m &&
            crest->elevation_rad + kSigmas * crest->elevation_sd_rad > elevation_rad)
          return crest->distance_m;
      }
    }
    const auto crest = highest_before(azimuth_rad, distance_m);
    return std::max(kNearest_m, crest ? crest->distance_m : distance_m);
  }

  // How high one sample is above the land in front of it. Seen from the camera, the sample
  // displaces all outlines sideways. The highest land of the model hides the sample, or nearer land
  // that is lower, but less well known. `crest_m`: the distance of that nearer land.
  double above_land(const AzimuthElevation& direction, double distance_m, double sideways_m,
                    double sigmas_higher, double crest_m) const {
    const double behind_m = 1.5 * crest_m;
    const double displaced_rad = direction.azimuth_rad + sideways_m / crest_m;
    auto highest = highest_before(displaced_rad, distance_m);
    if (!highest) return 1.0;  // land that is not known hides nothing
    const auto above = [&](const land::Skyline& land) {
      return direction.elevation_rad - land.elevation_rad - sigmas_higher * land.elevation_sd_rad;
    };
    if (highest->distance_m < behind_m) return above(*highest);
    const double far_rad = direction.azimuth_rad + sideways_m / highest->distance_m;
    const auto far = highest_before(far_rad, distance_m);
    if (far && far->distance_m >= behind_m) highest = far;
    const auto near = horizon_.highest_before(displaced_rad, behind_m);
    const bool counts = near && near->distance_m > kNearest_m;
    return counts ? std::min(above(*near), above(*highest)) : above(*highest);
  }

  Look look_at(std::size_t instant, int sample, double crest_m) const {
    static const Samples samples = draw_samples();
    const auto z = samples.col(sample);
    const Root& root = roots_[instant];
    const Eigen::Vector3d enu = root.mean_enu + root.root * z.head<3>();
    Look look{azimuth_elevation_from_enu(enu)};
    look.above_rad = above_land({look.direction.azimuth_rad, apparent_elevation(enu)},
                                enu.head<2>().norm(), kOutlineSd_m * z(4), z(3), crest_m);
    if (is_lost_at(look.direction, enu.norm(), {z(4), z(3)}))
      look.above_rad = std::min(look.above_rad, -kJustHidden_rad);
    return look;
  }

  // The edges of an obstacle are known to a cell: each sample displaces them.
  bool is_lost_at(const AzimuthElevation& direction, double distance_m,
                  const Eigen::Vector2d& sigmas) const {
    constexpr double kProbable = 0.5;
    if (obstacles_.lost == nullptr) return false;
    const Eigen::Vector2d off_rad = LostPlaces::kCell_rad / std::sqrt(12.0) * sigmas;
    return obstacles_.lost->probability(
               {direction.azimuth_rad + off_rad.x(), direction.elevation_rad + off_rad.y()},
               distance_m) > kProbable;
  }

  LandHorizon& horizon_;
  Obstacles obstacles_;
  std::span<const Position> path_;
  std::vector<Look> looks_;
  std::vector<Root> roots_;
  std::vector<double> crests_m_;  // of the nearest land that may hide the mean path, or its horizon
};

// An instant in the midst of the first occlusion that begins before `lead`: the earliest at which
// the target is about as probably hidden as ever in this occlusion. The occlusion has ended when
// this probability has fallen by half. A low probability suffices: a station uses the answer only
// once it no longer sees the target, and then an unlikely occlusion has become likely.
std::optional<std::size_t> midst(const Looks& looks, std::size_t lead) {
  constexpr double kPossible = 0.05, kAbout = 0.9, kEnded = 0.5;
  std::size_t first = 0;
  while (first < std::min(lead, looks.size()) && looks.hidden(first) < kPossible) ++first;
  if (first >= std::min(lead, looks.size())) return std::nullopt;
  double most = kPossible;
  for (std::size_t i = first; i < looks.size() && looks.hidden(i) >= kEnded * most; ++i)
    most = std::max(most, looks.hidden(i));
  while (looks.hidden(first) < kAbout * most) ++first;
  return first;
}

struct Out {  // of one sample
  double in_s = 0.0;
  Eigen::Vector2d off;  // from a reference: cross-elevation, elevation
};

std::optional<Out> out_after(const Looks& looks, int sample, std::size_t midst, double step_s,
                             const AzimuthElevation& reference) {
  std::size_t i = midst;
  while (i < looks.size() && looks.at(i, sample).above_rad < 0.0) ++i;
  if (i == looks.size()) return std::nullopt;
  const Look &before = looks.at(i - 1, sample), &after = looks.at(i, sample);
  const double share = before.above_rad / (before.above_rad - after.above_rad);
  const auto off = [&](const Look& look) {
    return Eigen::Vector2d(wrap_pi(look.direction.azimuth_rad - reference.azimuth_rad) *
                               std::cos(reference.elevation_rad),
                           look.direction.elevation_rad - reference.elevation_rad);
  };
  return Out{(static_cast<double>(i - 1) + share) * step_s,
             off(before) + share * (off(after) - off(before))};
}

std::optional<Emergence> emergence(const Looks& looks, std::size_t midst, double step_s) {
  constexpr double kEnough = 0.9;  // share of the samples that come out within the path
  const AzimuthElevation reference = looks.at(midst, 0).direction;
  std::vector<Out> outs;
  int hidden = 0;
  for (int k = 0; k < kSamples; ++k) {
    if (looks.at(midst, k).above_rad >= 0.0) continue;
    ++hidden;
    if (const auto out = out_after(looks, k, midst, step_s, reference)) outs.push_back(*out);
  }
  const auto count = static_cast<double>(outs.size());
  if (count < 2.0 || count < kEnough * hidden) return std::nullopt;
  Emergence exit;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Out& out : outs) {
    exit.in_s += out.in_s / count;
    mean += out.off / count;
  }
  double variance_s2 = 0.0;
  for (const Out& out : outs) {
    variance_s2 += std::pow(out.in_s - exit.in_s, 2) / (count - 1.0);
    exit.covariance += (out.off - mean) * (out.off - mean).transpose() / (count - 1.0);
  }
  exit.sd_s = std::sqrt(variance_s2);
  exit.direction = {
      wrap_two_pi(reference.azimuth_rad + mean.x() / std::cos(reference.elevation_rad)),
      reference.elevation_rad + mean.y()};
  return exit;
}

}  // namespace

std::optional<Occlusion> occlusion_ahead(LandHorizon& horizon, std::span<const Position> path,
                                         double step_s, double lead_s, const Obstacles& obstacles) {
  if (path.empty()) return std::nullopt;
  Looks looks(horizon, obstacles, path);
  const auto lead = static_cast<std::size_t>(lead_s / step_s) + 1;
  // A few samples show whether a target is anywhere near the horizon.
  looks.look(0, kFirstLook);
  bool any = false;
  for (std::size_t i = 0; i < std::min(lead, path.size()); ++i) {
    any = any || looks.hidden(i, kFirstLook) > 0.0;
  }
  if (!any) return std::nullopt;
  looks.look(kFirstLook, kSamples);
  const auto most = midst(looks, lead);
  if (!most) return std::nullopt;
  return Occlusion{looks.hidden(0), emergence(looks, *most, step_s)};
}

}  // namespace ols::fusion
