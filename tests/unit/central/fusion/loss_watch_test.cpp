// A target flies to and fro before four stations, and something hides it from one of them.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include "central/fusion/fusion.h"
#include "tests/unit/central/ground/lands.h"
#include "tests/unit/central/scene.h"

namespace ols::fusion {
namespace {

constexpr std::int64_t kStart = 1'700'000'000'000'000;
constexpr double kTurns_s = 5.0;  // it turns round after this time
constexpr double kFps = 10.0;

Eigen::Vector3d target(double t_s) {
  const double phase = std::fmod(t_s, 2.0 * kTurns_s);
  return {20.0 * (phase < kTurns_s ? phase : 2.0 * kTurns_s - phase) - 50.0, 150.0, 120.0};
}

using Hidden = std::function<bool(double t_s)>;

// `hidden`: when the first station does not see the target.
Fusion fusion_after(int passes, const Hidden& hidden, const Land::Height& land) {
  Geodetic place = test::site().origin();
  place.height_m = 0.0;
  FusionConfig config;
  config.land.surface = std::make_shared<const Land>(land, 1.0, place);
  config.slew.rate_hz = 0.01;  // nothing is led here, and predictions take time
  Fusion fusion(config);
  for (int i = 0; i < static_cast<int>(4 * kFps * kTurns_s * passes); ++i) {
    const double t_s = i / (4 * kFps);
    if (i % 4 == 0 && hidden(t_s)) continue;
    const Ray ray =
        test::ray_to(std::string(1, static_cast<char>('a' + i % 4)),
                     test::square()[static_cast<std::size_t>(i % 4)], target(t_s), 1e-4);
    (void)fusion.add(test::measurement_of(ray, kStart + std::llround(t_s * 1e6)));
  }
  return fusion;
}

double level(double, double) { return test::site().origin().height_m - 100.0; }

std::vector<Alarm> lost_places(const Fusion& fusion) {
  std::vector<Alarm> alarms = fusion.health().alarms;
  std::erase_if(alarms, [](const Alarm& a) { return a.id != "targets_lost_at_place"; });
  return alarms;
}

TEST(LossWatch, NamesTheStationAndThePlaceWhereTargetsAreLost) {
  const auto behind_a_crane = [](double t_s) { return std::abs(target(t_s).x()) < 12.0; };
  EXPECT_TRUE(lost_places(fusion_after(2, behind_a_crane, level)).empty());
  const Fusion fusion = fusion_after(7, behind_a_crane, level);
  const auto alarms = lost_places(fusion);
  ASSERT_EQ(alarms.size(), 1U);
  EXPECT_EQ(alarms[0].parameter("station"), "a");
  const Eigen::Vector3d off = Eigen::Vector3d(0.0, 150.0, 120.0) - test::square()[0];
  const double azimuth_deg = degrees(wrap_two_pi(std::atan2(off.x(), off.y())));
  const double from_deg = std::stod(alarms[0].parameter("from_deg"));
  const double to_deg = std::stod(alarms[0].parameter("to_deg"));
  EXPECT_LT(from_deg, azimuth_deg);
  EXPECT_GT(to_deg, azimuth_deg);
  EXPECT_LT(to_deg - from_deg, 12.0);
  const LossWatch& losses = fusion.tracks().losses();
  const Eigen::Vector3d camera_ecef = test::site().to_ecef(test::square()[0]);
  const auto hidden = [&](double x_m) {
    return losses.hidden("a", camera_ecef, test::site().to_ecef({x_m, 150.0, 120.0}));
  };
  EXPECT_GT(hidden(0.0), 0.99);
  EXPECT_LT(hidden(40.0), 0.01);
}

// Losses at another place in each pass, and a loss for which the model of the land has the reason.
TEST(LossWatch, IsSilentAboutChanceAndAboutKnownLand) {
  const auto elsewhere = [](double t_s) {
    const double x_m = -40.0 + 20.0 * std::floor(t_s / (2.0 * kTurns_s));
    return std::abs(target(t_s).x() - x_m) < 8.0 && std::fmod(t_s, 2.0 * kTurns_s) < kTurns_s;
  };
  EXPECT_TRUE(lost_places(fusion_after(7, elsewhere, level)).empty());
  const auto wall = [](double east_m, double north_m) {
    const bool is_wall = std::abs(north_m - 120.0) < 10.0 && std::abs(east_m) < 60.0;
    return level(0.0, 0.0) + (is_wall ? 400.0 : 0.0);
  };
  const auto behind = [](double t_s) { return std::abs(target(t_s).x()) < 12.0; };
  EXPECT_TRUE(lost_places(fusion_after(7, behind, wall)).empty());
}

}  // namespace
}  // namespace ols::fusion
