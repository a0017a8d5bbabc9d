#include "central/ground/ground_point.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <random>

#include "central/ground/above_ground.h"
#include "central/ground/visibility.h"
#include "geometry/angles.h"
#include "land/refraction.h"
#include "land/terrain_folder.h"
#include "tests/unit/central/ground/lands.h"
#include "tests/unit/folder_test.h"
#include "tools/land/land_import.h"

namespace ols::fusion {
namespace {

// A camera's view of a place: along the bent line.
LineOfSight sight_of(const Eigen::Vector3d& camera, const Eigen::Vector3d& p_ecef, double white_rad,
                     double systematic_rad) {
  LineOfSight sight;
  sight.origin_ecef = camera;
  const Eigen::Vector3d line = R_ecef_enu(camera).transpose() * (p_ecef - camera);
  sight.direction = azimuth_elevation_from_enu(line);
  sight.direction.elevation_rad +=
      std::atan(land::refraction_slope(land::kRefraction, line.norm()));
  sight.covariance_white = Eigen::Matrix2d::Identity() * white_rad * white_rad;
  sight.covariance_systematic = Eigen::Matrix2d::Identity() * systematic_rad * systematic_rad;
  return sight;
}

TEST(GroundPoint, APlaneGivesHeightOverTheGrazingAngle) {
  struct Case {
    double camera_m, slope, range_m;
  };
  for (const Case& c : {Case{100.0, 0.0, 1000.0}, {100.0, 0.05, 2000.0}, {300.0, -0.03, 3000.0}}) {
    SCOPED_TRACE(c.range_m);
    const Land land([&c](double east_m, double) { return c.slope * east_m; });
    const Eigen::Vector3d camera = land.on_ground(0.0, 0.0, c.camera_m);
    const Eigen::Vector3d truth = land.on_ground(c.range_m, 0.0, kMiddle_m);
    const auto found = ground_point(land, sight_of(camera, truth, 1e-4, 2e-4));
    ASSERT_TRUE(found);
    EXPECT_LT((found->p_ecef - truth).norm(), 0.02 * c.range_m);
    const Eigen::Matrix3d R = R_ecef_enu(truth);
    const Eigen::Matrix3d P = R.transpose() * found->covariance_ecef * R;
    const double tan_grazing = (c.camera_m - kMiddle_m) / c.range_m;  // against the slope
    const double height_sd_m = std::hypot(1.0, kMiddleSd_m, c.range_m * std::hypot(1e-4, 2e-4));
    EXPECT_NEAR(std::sqrt(P(0, 0)), height_sd_m / tan_grazing, 0.1 * height_sd_m / tan_grazing);
    EXPECT_NEAR(std::sqrt(P(1, 1)), c.range_m * std::hypot(1e-4, 2e-4), 0.05);
    const Eigen::Matrix3d white = R.transpose() * found->covariance_white_ecef * R;
    EXPECT_NEAR(white(0, 0) / P(0, 0), std::pow(c.range_m * 1e-4 / height_sd_m, 2), 0.02);
  }
}

TEST(GroundPoint, NoneWhereTheLineEndsInNoKnownGround) {
  const Land land(flat), hill([](double east_m, double) { return east_m > 900.0 ? 200.0 : 0.0; });
  const Eigen::Vector3d camera = land.at(0.0, 0.0, 10.0);
  const auto at = [&](double elevation_rad) {
    LineOfSight sight = sight_of(camera, land.at(1000.0, 0.0, 0.0), 1e-4, 1e-4);
    sight.direction.elevation_rad = elevation_rad;
    return sight;
  };
  EXPECT_FALSE(ground_point(land, at(0.02)));     // into the sky
  EXPECT_TRUE(ground_point(hill, at(0.02)));      // into a hill
  EXPECT_FALSE(ground_point(land, at(-1.5e-3)));  // it grazes: any range beyond 3 km
  EXPECT_FALSE(ground_point(land, at(-2e-4)));    // it leaves the known land
  EXPECT_TRUE(ground_point(land, at(-0.02)));
}

// A crest at 1000 m, over which the line passes by a fraction of its error, and a slope behind.
TEST(GroundPoint, AGrazedCrestAndTheSlopeBehindAreAMixture) {
  const Land land([](double east_m, double) {
    return 30.0 * std::exp(-std::pow((east_m - 1000.0) / 60.0, 2)) +
           std::max(0.0, 0.3 * (east_m - 1300.0));
  });
  const Eigen::Vector3d camera = land.at(0.0, 0.0, 40.0);
  const auto found =
      ground_point(land, sight_of(camera, land.at(1000.0, 0.0, 30.0 + kMiddle_m), 3e-4, 3e-4));
  ASSERT_TRUE(found);
  const Eigen::Vector3d east = R_ecef_enu(found->p_ecef).col(0);
  EXPECT_GT(std::sqrt(east.dot(found->covariance_ecef * east)), 80.0);
  EXPECT_GT(found->range_m, 1020.0);
  EXPECT_LT(found->range_m, 1350.0);
}

// Ground with hills, and a model of it with an error of its own.
struct Hills {
  struct Wave {
    double height_m, along, across, phase;
  };
  std::vector<Wave> waves;

  Hills(std::mt19937& random, double sd_m, double shortest_m, double longest_m) {
    constexpr int kWaves = 12;
    std::uniform_real_distribution<double> any(0.0, 1.0);
    for (int i = 0; i < kWaves; ++i) {
      const double length_m = shortest_m * std::pow(longest_m / shortest_m, any(random));
      const double turned = 2.0 * std::numbers::pi * any(random);
      const double k = 2.0 * std::numbers::pi / length_m;
      waves.push_back({sd_m * std::sqrt(2.0 / kWaves), k * std::cos(turned), k * std::sin(turned),
                       2.0 * std::numbers::pi * any(random)});
    }
  }
  double operator()(double east_m, double north_m) const {
    double sum = 0.0;
    for (const Wave& w : waves)
      sum += w.height_m * std::sin(w.along * east_m + w.across * north_m + w.phase);
    return sum;
  }
};

struct Score {
  int looks = 0, found = 0, single = 0;
  double nees = 0.0, over_bound = 0.0;
};

// A place above the ground; nullopt where there is none.
std::optional<Eigen::Vector3d> standing_on(const land::Surface& land, const LocalFrame& frame,
                                           double east_m, double north_m, double above_m) {
  Geodetic at = geodetic_from_ecef(frame.to_ecef({east_m, north_m, 0.0}));
  const auto ground = land.ground(at.latitude_rad, at.longitude_rad);
  if (!ground) return std::nullopt;
  at.height_m = ground->height_m + above_m;
  return ecef_from_geodetic(at);
}

// The ground, a model of it, and a camera above it.
struct Scene {
  const land::Surface& exact;  // its own sigma is zero
  const land::Surface& model;
  double model_sd_m;
  LocalFrame frame;
  Eigen::Vector3d camera;
};

// One drive of a minute at 10 m/s, seen by one station.
void drive(std::mt19937& random, const Scene& scene, Score& score) {
  constexpr double kWhite_rad = 1e-4, kSystematic_rad = 1.5e-4;
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> any(0.0, 1.0);
  const Eigen::Vector3d& camera = scene.camera;
  const Eigen::Vector2d bias = kSystematic_rad * Eigen::Vector2d(normal(random), normal(random));
  const double range_m = 500.0 + 2500.0 * any(random), azimuth = 6.28 * any(random);
  const double course = 6.28 * any(random);
  const double middle_m = kMiddle_m + kMiddleSd_m * normal(random);
  for (int second = 0; second < 60; second += 5) {
    const double e = range_m * std::sin(azimuth) + 10.0 * second * std::sin(course);
    const double n = range_m * std::cos(azimuth) + 10.0 * second * std::cos(course);
    const auto on_ground = standing_on(scene.exact, scene.frame, e, n, middle_m);
    if (!on_ground) continue;
    const Eigen::Vector3d p = *on_ground;
    const double far_m = (p - camera).norm();
    if (far_m < 500.0 || far_m > 3000.0) continue;
    if (visibility(scene.exact, camera, p, Eigen::Matrix3d::Identity() * 1e-6) < 0.5) continue;
    LineOfSight sight = sight_of(camera, p, kWhite_rad, kSystematic_rad);
    sight.direction.azimuth_rad +=
        (bias.x() + kWhite_rad * normal(random)) / std::cos(sight.direction.elevation_rad);
    sight.direction.elevation_rad += bias.y() + kWhite_rad * normal(random);
    ++score.looks;
    const auto found = ground_point(scene.model, sight);
    if (!found) continue;
    ++score.found;
    const Eigen::Vector3d off = found->p_ecef - p;
    score.nees += off.dot(found->covariance_ecef.llt().solve(off)) / 3.0;
    // The bound: the plane of the true ground under the target, and errors as stated.
    const auto ground = local_ground(scene.exact, p, Eigen::Matrix3d::Zero());
    const Eigen::Vector3d line = R_ecef_enu(p).transpose() * (p - camera) / far_m;
    const double falls = ground->slope.dot(line.head<2>()) - line.z();
    const double angle_rad = std::hypot(kWhite_rad, kSystematic_rad);
    const double height_sd_m = std::hypot(scene.model_sd_m, kMiddleSd_m, far_m * angle_rad);
    const double bound_m = std::hypot(height_sd_m / falls, far_m * angle_rad);
    if (falls < 0.0 || std::sqrt(found->covariance_ecef.trace()) > 1.5 * bound_m) continue;
    ++score.single;  // the others are mixtures: the plane is no bound for them
    score.over_bound += off.squaredNorm() / (bound_m * bound_m);
  }
}

void expect_consistent(const Score& score) {
  const double nees = score.nees / score.found;
  const double over = std::sqrt(score.over_bound / score.single);
  std::printf("%d of %d looks, NEES %.2f; %d are no mixtures, with error over bound %.2f\n",
              score.found, score.looks, nees, score.single, over);
  EXPECT_LT(over, 1.2);
  EXPECT_GT(nees, 0.7);
  EXPECT_LT(nees, 1.4);
}

TEST(GroundPoint, OfAVehicleOnHillsIsConsistent) {
  for (const double high_m : {20.0, 60.0}) {
    for (const double model_sd_m : {0.5, 2.0}) {
      constexpr unsigned kSeed = 42;
      std::mt19937 random(kSeed);
      Score score;
      for (int i = 0; i < 60; ++i) {
        const Hills hills(random, 15.0, 500.0, 3000.0), error(random, model_sd_m, 150.0, 2000.0);
        const Land exact(hills, 0.0);
        const Land model([&](double e, double n) { return hills(e, n) + error(e, n); }, model_sd_m);
        drive(random,
              {exact, model, model_sd_m, LocalFrame(kPlace), exact.on_ground(0.0, 0.0, high_m)},
              score);
      }
      std::printf("seed %u, station %.0f m high, model %.1f m: ", kSeed, high_m, model_sd_m);
      expect_consistent(score);
    }
  }
}

// A model of the land, and what that land may be according to the model's sigma.
class WithError : public land::Surface {
 public:
  WithError(const land::Surface& model, const Geodetic& place, Hills error)
      : model_(model), frame_(place), error_(std::move(error)) {}
  std::optional<land::SurfaceHeight> ground(double latitude_rad,
                                            double longitude_rad) const override {
    const auto known = model_.ground(latitude_rad, longitude_rad);
    if (!known) return known;
    const Eigen::Vector3d at =
        frame_.to_enu(ecef_from_geodetic({latitude_rad, longitude_rad, 0.0}));
    return land::SurfaceHeight{known->height_m + error_(at.x(), at.y()), 0.0};
  }
  std::optional<land::SurfaceHeight> top(double latitude_rad, double longitude_rad) const override {
    return ground(latitude_rad, longitude_rad);
  }

 private:
  const land::Surface& model_;
  LocalFrame frame_;
  Hills error_;
};

// A volcano and its foot, as of a satellite's radar.
using RealGround = FolderTest<>;

TEST_F(RealGround, OfAVehicleIsConsistent) {
  const char* shared = std::getenv("OLS_SHARED");
  const std::string tile =
      std::string(shared != nullptr ? shared : "") + "/data/terrain/N38W029.SRTMGL3.hgt.zip";
  if (!std::filesystem::exists(tile)) GTEST_SKIP() << "OLS_SHARED is not set";
  land::ImportOptions options;
  options.elevation = {tile};
  options.latitude_deg = 38.47;
  options.longitude_deg = -28.35;
  options.radius_km = 15.0;
  options.output = folder_ + "/land";
  land::import_land(options);
  const auto model = land::read_terrain_folder(options.output).terrain;
  constexpr double kSea_m = 65.0;  // above the ellipsoid, with the lowest shore
  constexpr unsigned kSeed = 42;
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  Score score;
  for (int i = 0; i < 200; ++i) {
    const Geodetic place{radians(options.latitude_deg + 0.1 * any(random)),
                         radians(options.longitude_deg + 0.1 * any(random)), 0.0};
    const auto known = model->ground(place.latitude_rad, place.longitude_rad);
    if (!known || known->height_m < kSea_m) continue;
    const WithError exact(*model, place, Hills(random, options.sd_m, 150.0, 2000.0));
    const LocalFrame frame(place);
    const auto camera = standing_on(exact, frame, 0.0, 0.0, 20.0);
    drive(random, {exact, *model, options.sd_m, frame, *camera}, score);
  }
  std::printf("seed %u, a real volcano: ", kSeed);
  expect_consistent(score);
}

}  // namespace
}  // namespace ols::fusion
