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
  Looks(LandHorizon& horizon, const land::SeenSkyline* seen, std::span<const Position> path)
      : horizon_(horizon),
        seen_(seen),
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
      // Beside a house the mean path has only the land behind the house, but samples may have the
      // house itself. So the nearest horizon around counts.
      constexpr std::size_t kBeside = 20;
      const auto from_i = i < kBeside ? 0 : i - kBeside;
      const auto to_i = std::min(path_.size(), i + kBeside + 1);
      const double crest_m =
          *std::min_element(crests_m_.begin() + static_cast<std::ptrdiff_t>(from_i),
                            crests_m_.begin() + static_cast<std::ptrdiff_t>(to_i));
      for (int k = from; k < to; ++k) looks_[i * kSamples + index(k)] = look_at(i, k, crest_m);
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
  struct Root {
    Eigen::Vector3d mean_enu;
    Eigen::Matrix3d root;
  };
  static std::size_t index(int sample) { return static_cast<std::size_t>(sample); }

  std::optional<land::Skyline> highest_before(double azimuth_rad, double distance_m) const {
    const auto land = horizon_.highest_before(azimuth_rad, distance_m);
    return land && seen_ != nullptr ? seen_->hiding(*land, azimuth_rad, distance_m) : land;
  }

  double crest_at(std::size_t instant) const {
    constexpr double kNearest_m = 20.0;
    const Eigen::Vector3d& enu = roots_[instant].mean_enu;
    const auto crest = highest_before(std::atan2(enu.x(), enu.y()), enu.head<2>().norm());
    return std::max(kNearest_m, crest ? crest->distance_m : kNearest_m);
  }

  Look look_at(std::size_t instant, int sample, double crest_m) const {
    // Outlines of buildings are mapped to a metre or two.
    constexpr double kOutlineSd_m = 1.0;
    static const Samples samples = draw_samples();
    const auto z = samples.col(sample);
    const Root& root = roots_[instant];
    const Eigen::Vector3d enu = root.mean_enu + root.root * z.head<3>();
    const double distance_m = enu.head<2>().norm();
    Look look{azimuth_elevation_from_enu(enu), 1.0};
    const auto land =
        highest_before(look.direction.azimuth_rad + kOutlineSd_m * z(4) / crest_m, distance_m);
    if (!land) return look;  // land that is not known hides nothing
    const double lift = land::refraction_slope(land::kRefraction, distance_m);
    look.above_rad = std::atan(enu.z() / std::max(1.0, distance_m) + lift) - land->elevation_rad -
                     z(3) * land->elevation_sd_rad;
    return look;
  }

  LandHorizon& horizon_;
  const land::SeenSkyline* seen_;
  std::span<const Position> path_;
  std::vector<Look> looks_;
  std::vector<Root> roots_;
  std::vector<double> crests_m_;  // distance of the horizon below the mean path
};

// The instant at which the target is most probably hidden, in the first occlusion that begins
// before `lead`. A low probability suffices: a station uses the answer only once it no longer sees
// the target, and then an unlikely occlusion has become likely.
std::optional<std::size_t> midst(const Looks& looks, std::size_t lead) {
  constexpr double kPossible = 0.05;
  std::size_t first = 0;
  while (first < std::min(lead, looks.size()) && looks.hidden(first) < kPossible) ++first;
  if (first >= std::min(lead, looks.size())) return std::nullopt;
  std::size_t most = first;
  for (std::size_t i = first; i < looks.size() && looks.hidden(i) >= kPossible; ++i) {
    if (looks.hidden(i) > looks.hidden(most)) most = i;
  }
  return most;
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
                                         double step_s, double lead_s,
                                         const land::SeenSkyline* seen) {
  if (path.empty()) return std::nullopt;
  Looks looks(horizon, seen, path);
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
