#include "calibration/pictures/picture_angles.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "calibration/pictures/scene_tracks.h"
#include "calibration/pictures/view_registration.h"
#include "geometry/median.h"

namespace ols::calibration {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

using Angles = std::vector<std::optional<PanTilt>>;

constexpr double kLeft_px = 10.0;    // left by the registration of whole pictures
constexpr double kStep_rad = 1e-5;   // of numerical derivatives
constexpr double kLoose_rad = 0.02;  // prior of a picture's angles after that
constexpr int kRounds = 4, kLeastPoints = 5;

PanTilt plus(const PanTilt& a, const Vector2d& by) {
  return {a.pan_rad + by.x(), a.tilt_rad + by.y()};
}

std::optional<Vector2d> seen_from(const StationGeometry& g, const Vector2d& pixel,
                                  const PanTilt& from, const PanTilt& to) {
  const auto ray = unproject(g.camera, pixel);
  if (!ray) return std::nullopt;
  const Eigen::Vector3d there = enu_from_camera(g.chain, to).linear().transpose() *
                                enu_from_camera(g.chain, from).linear() * *ray;
  if (there.z() <= 0.0) return std::nullopt;
  return project(g.camera, there);
}

// By `to`, or by `from` if that is asked for.
std::optional<Matrix2d> derivative(const StationGeometry& g, const Vector2d& pixel,
                                   const PanTilt& from, const PanTilt& to, bool by_from) {
  Matrix2d J;
  for (int axis = 0; axis < 2; ++axis) {
    const Vector2d step = kStep_rad * Vector2d::Unit(axis);
    const auto ahead = by_from ? seen_from(g, pixel, plus(from, step), to)
                               : seen_from(g, pixel, from, plus(to, step));
    const auto behind = by_from ? seen_from(g, pixel, plus(from, -step), to)
                                : seen_from(g, pixel, from, plus(to, -step));
    if (!ahead || !behind) return std::nullopt;
    J.col(axis) = (*ahead - *behind) / (2.0 * kStep_rad);
  }
  return J;
}

// The angles of a view whose middle is this far beside that of a picture with known angles.
std::optional<PanTilt> moved_by(const StationGeometry& g, const PanTilt& from,
                                const Vector2d& shift_px) {
  const Vector2d middle(0.5 * (g.camera.width_px - 1), 0.5 * (g.camera.height_px - 1));
  PanTilt to = from;
  for (int round = 0; round < kRounds; ++round) {
    const auto at = seen_from(g, middle, from, to);
    const auto J = derivative(g, middle, from, to, false);
    if (!at || !J || std::abs(J->determinant()) < 1.0) return std::nullopt;
    to = plus(to, J->inverse() * (middle + shift_px - *at));
  }
  return to;
}

// Each picture is joined to one at rest that is known already: the nearest by the reports that
// shows the same. Reports may be late or wrong, so some are tried.
Angles coarse(const StationGeometry& g, const std::vector<TurnedPicture>& pictures) {
  constexpr std::size_t kTries = 4;
  Angles angles(pictures.size());
  std::vector<std::size_t> rests;
  const auto join = [&](std::size_t i) {
    const auto distance = [&](std::size_t rest) {
      return std::hypot(pictures[rest].reported.pan_rad - pictures[i].reported.pan_rad,
                        pictures[rest].reported.tilt_rad - pictures[i].reported.tilt_rad);
    };
    std::vector<std::size_t> near = rests;
    std::ranges::sort(near, {}, distance);
    near.resize(std::min(near.size(), kTries));
    for (const std::size_t rest : near) {
      const ViewRegistration found = register_view(pictures[rest].gray, pictures[i].gray);
      if (found) angles[i] = moved_by(g, *angles[rest], found.shift_px);
      if (angles[i]) return;
    }
  };
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    if (pictures[i].moves) continue;
    join(i);
    if (!angles[i] && rests.size() <= 1) {  // nothing is like the first one: begins anew
      if (!rests.empty()) angles[rests.back()].reset();
      rests.clear();
      angles[i] = pictures[i].reported;
    }
    if (angles[i]) rests.push_back(i);
  }
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    if (pictures[i].moves) join(i);
  }
  return angles;
}

struct Pair {
  std::size_t from = 0, to = 0;
  Vector2d from_px = Vector2d::Zero(), to_px = Vector2d::Zero();
  Vector2d residual_px = Vector2d::Zero();
};

std::vector<Pair> pairs_of(const StationGeometry& g, const std::vector<TurnedPicture>& pictures,
                           const Angles& angles) {
  SceneTrackOptions options;
  options.reach_px = kLeft_px;
  SceneTracks tracks(g, options);
  std::vector<std::size_t> taken;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    if (!angles[i]) continue;
    tracks.add(pictures[i].gray, *angles[i]);
    taken.push_back(i);
  }
  std::map<int, SceneSighting> first;
  std::vector<Pair> pairs;
  for (const SceneSighting& one : tracks.sightings()) {
    const auto [known, is_new] = first.try_emplace(one.track, one);
    if (is_new) continue;
    pairs.push_back({taken[known->second.picture], taken[one.picture], known->second.pixel,
                     one.pixel, Vector2d::Zero()});
  }
  return pairs;
}

double rms(const std::vector<Pair>& pairs) {
  double sum = 0.0;
  for (const Pair& pair : pairs) sum += pair.residual_px.squaredNorm();
  return pairs.empty() ? 0.0 : std::sqrt(0.5 * sum / static_cast<double>(pairs.size()));
}

// One round of least squares over all known pictures but the first.
void improve(const StationGeometry& g, Angles& angles, std::vector<Pair>& pairs) {
  const auto size = static_cast<Eigen::Index>(2 * angles.size());
  Eigen::MatrixXd N = Eigen::MatrixXd::Identity(size, size) / (kLoose_rad * kLoose_rad);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(size);
  const auto fixed =
      2 *
      (std::ranges::find_if(angles, [](const auto& a) { return a.has_value(); }) - angles.begin());
  N(fixed, fixed) = N(fixed + 1, fixed + 1) = 1e20;
  for (Pair& pair : pairs) {
    const PanTilt &from = *angles[pair.from], &to = *angles[pair.to];
    const auto at = seen_from(g, pair.from_px, from, to);
    const auto by_from = derivative(g, pair.from_px, from, to, true);
    const auto by_to = derivative(g, pair.from_px, from, to, false);
    if (!at || !by_from || !by_to) continue;
    pair.residual_px = pair.to_px - *at;
    Eigen::Matrix<double, 2, 4> J;
    J << *by_from, *by_to;
    const auto i = static_cast<Eigen::Index>(2 * pair.from);
    const auto j = static_cast<Eigen::Index>(2 * pair.to);
    const Eigen::Vector4i at_index(static_cast<int>(i), static_cast<int>(i + 1),
                                   static_cast<int>(j), static_cast<int>(j + 1));
    const Eigen::Matrix4d JJ = J.transpose() * J;
    const Eigen::Vector4d Jr = J.transpose() * pair.residual_px;
    for (int r = 0; r < 4; ++r) {
      b(at_index(r)) += Jr(r);
      for (int c = 0; c < 4; ++c) N(at_index(r), at_index(c)) += JJ(r, c);
    }
  }
  const Eigen::VectorXd by = N.ldlt().solve(b);
  for (std::size_t i = 0; i < angles.size(); ++i) {
    if (angles[i]) angles[i] = plus(*angles[i], by.segment<2>(static_cast<Eigen::Index>(2 * i)));
  }
}

// What moves in the scene, and false matches.
void drop_strays(std::vector<Pair>& pairs) {
  if (pairs.empty()) return;
  std::vector<double> sizes;
  for (const Pair& pair : pairs) sizes.push_back(pair.residual_px.norm());
  const double most_px = std::max(4.0 * median(std::move(sizes)), 0.1);
  std::erase_if(pairs, [most_px](const Pair& pair) { return pair.residual_px.norm() > most_px; });
}

}  // namespace

PictureAngles angles_of_pictures(const StationGeometry& g,
                                 const std::vector<TurnedPicture>& pictures) {
  PictureAngles result;
  result.angles = coarse(g, pictures);
  if (pictures.empty()) return result;
  std::vector<Pair> pairs = pairs_of(g, pictures, result.angles);
  for (int round = 0; round < kRounds; ++round) {
    improve(g, result.angles, pairs);
    drop_strays(pairs);
  }
  std::vector<int> points(pictures.size());
  for (const Pair& pair : pairs) ++points[pair.from], ++points[pair.to];
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    if (points[i] < kLeastPoints) result.angles[i].reset();
  }
  result.rms_px = rms(pairs);
  return result;
}

}  // namespace ols::calibration
