// A camera with a wide lens that stands still, from what it can see: the turning sky, landmarks,
// and a drone that reports where it is.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <random>

#include "calibration/systematic.h"
#include "tests/unit/calibration/star_scene.h"

namespace ols::calibration {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using test::kNight_us;

constexpr double kSd_px = 0.3;
constexpr std::array<int, 8> kLens{kFocal, kAspect, kCx, kCy, kK1, kK2, kK3, kK4};

// Before the calibration: a fisheye or polynomial of about 90 degrees, without gears.
StationPrior unknown_lens(LensModel lens) {
  StationPrior prior = test::prior_of(test::hill());
  prior.pose_sd_rad = 1e-8;
  CameraIntrinsics& camera = prior.model.geometry.camera;
  camera.model = lens;
  camera.fx_px = camera.fy_px = 829.0;
  prior.model.geometry.chain.tilt_zero_rad = radians(35.0);
  StationMatrix& C = prior.covariance;
  for (int k = kTrunnion; k <= kExposureOffset; ++k) C(k, k) = 0.0;
  C(kFocal, kFocal) = std::pow(0.003 * camera.fx_px, 2);
  for (const int k : {kK1, kK2, kK3, kK4}) C(k, k) = std::pow(0.02, 2);
  return prior;
}

class Scene {
 public:
  Scene(std::uint32_t seed, LensModel lens) : random_(seed) {
    problem_.names = {"alfa"};
    problem_.stations = {unknown_lens(lens)};
    truth_ = test::drawn(random_, problem_.stations.front());
  }
  const StationModel& truth() const { return truth_; }
  const Problem& problem() const { return problem_; }

  // Some of the table's stars in the picture, four times in a night.
  void add_stars() {
    const Geodetic& place = truth_.geometry.position;
    std::vector<Star> stars;
    for (const TableStar& star : star_table()) stars.push_back(star_of(star));
    for (int hour = 0; hour < 4; ++hour) {
      const std::int64_t utime_us = kNight_us + hour * 3'600'000'000;
      for (const auto& [i, direction] :
           stars_between(stars, 10.0, 89.0, utime_us, place, standard_air(place.height_m), {})) {
        if (i % 96 != 0) continue;
        const std::string name = "HIP " + std::to_string(star_table()[i].hip);
        problem_.references[name] = stars[i];
        see(Kind::kStar, name, utime_us, {R_ecef_enu(place).transpose() * direction.ecef, 0.0});
      }
    }
  }
  // Places that project there, by the truth.
  void add_landmarks() {
    for (int i = 0; i < 8; ++i) {
      const Vector2d pixel(80.0 + 160.0 * i, 850.0 - 30.0 * (i % 3));
      Observation one = observation(Kind::kLandmark, "landmark" + std::to_string(i), kNight_us);
      one.pixel = pixel;
      problem_.references[one.reference] = test::place_seen(truth_, one, 500.0 + 100.0 * i);
      add(one);
    }
  }
  // A drone on its way across the picture, at 300 m.
  void add_drone() {
    Trajectory track;
    track.sd_m = 0.05;
    for (int i = 0; i < 30; ++i) {
      Observation one = observation(Kind::kDrone, "drone", kNight_us + i * 500'000);
      one.pixel = Vector2d(60.0 + 40.0 * i, 480.0 + 380.0 * std::sin(0.5 * i));
      track.points.push_back({one.utime_us, test::place_seen(truth_, one, 300.0).ecef});
      add(one);
    }
    problem_.references["drone"] = track;
  }

 private:
  static Observation observation(Kind kind, const std::string& name, std::int64_t utime_us) {
    Observation one;
    one.kind = kind;
    one.utime_us = utime_us;
    one.sd_px = kSd_px;
    one.reference = name;
    return one;
  }
  void see(Kind kind, const std::string& name, std::int64_t utime_us,
           const HomogeneousPoint& point) {
    const CameraIntrinsics& camera = truth_.geometry.camera;
    const auto image = predict_pixel(truth_, {}, point);
    if (!image || image->pixel.minCoeff() < 0.0 || image->pixel.x() > camera.width_px - 1.0 ||
        image->pixel.y() > camera.height_px - 1.0) {
      return;
    }
    Observation one = observation(kind, name, utime_us);
    one.pixel = image->pixel;
    add(one);
  }
  void add(Observation one) {
    one.pixel += kSd_px * Vector2d(normal_(random_), normal_(random_));
    one.line = static_cast<unsigned>(problem_.observations.size() + 1);
    problem_.observations.push_back(one);
  }

  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  Problem problem_;
  StationModel truth_;
};

// Squares of errors over their told variances, each a mean of 1.
struct Squares {
  double lens = 0.0;       // of the eight parameters of the lens, whitened
  double direction = 0.0;  // of directions all over the picture, each axis
};

Squares squares_of(const Scene& scene) {
  const Calibration found = calibrate(Adjustment(network_of(scene.problem())));
  const StationModel& model = found.fit.state.stations[0].model;
  const StationMatrix covariance = found.covariance(network_of(scene.problem()), 0);
  const InstrumentVector off = instrument_of(model) - instrument_of(scene.truth());
  const Eigen::Matrix<double, 8, 1> off_lens = off(kLens);
  const Eigen::Matrix<double, 8, 8> C = covariance(kLens, kLens);
  Squares squares{off_lens.dot(C.ldlt().solve(off_lens)) / 8.0, 0.0};
  int count = 0;
  for (const double x : {20.0, 320.0, 640.0, 960.0, 1260.0}) {
    for (const double y : {20.0, 240.0, 480.0, 720.0, 940.0}) {
      const auto here = systematic_direction(model, covariance, {}, {x, y});
      const auto there = systematic_direction(scene.truth(), covariance, {}, {x, y});
      const Vector3d apart = enu_from_azimuth_elevation(there->direction) -
                             enu_from_azimuth_elevation(here->direction);
      const Vector2d error = tangent_basis(here->direction).transpose() * apart;
      squares.direction += error.dot(here->covariance_rad2.inverse() * error) / 2.0;
      ++count;
    }
  }
  squares.direction /= count;
  return squares;
}

class WideLens : public testing::TestWithParam<LensModel> {};

TEST_P(WideLens, ItsErrorsAreWithinThoseStated) {
  constexpr int kCameras = 4;
  Squares mean;
  for (std::uint32_t seed = 1; seed <= kCameras; ++seed) {
    Scene scene(seed, GetParam());
    scene.add_stars();
    scene.add_landmarks();
    scene.add_drone();
    const Squares one = squares_of(scene);
    mean.lens += one.lens / kCameras;
    mean.direction += one.direction / kCameras;
  }
  RecordProperty("lens_squares", std::to_string(mean.lens));
  RecordProperty("direction_squares", std::to_string(mean.direction));
  // Of 32 numbers: within four deviations. Those of directions depend on each other.
  EXPECT_NEAR(mean.lens, 1.0, 4.0 * std::sqrt(2.0 / (8.0 * kCameras)));
  EXPECT_GT(mean.direction, 0.4);
  EXPECT_LT(mean.direction, 2.0);
}

INSTANTIATE_TEST_SUITE_P(Models, WideLens,
                         testing::Values(LensModel::kFisheye, LensModel::kPolynomial));

}  // namespace
}  // namespace ols::calibration
