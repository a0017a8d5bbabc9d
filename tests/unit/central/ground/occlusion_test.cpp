#include "central/ground/occlusion.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <vector>

#include "geometry/angles.h"
#include "tests/unit/central/ground/lands.h"

namespace ols::fusion {
namespace {

constexpr double kStep_s = 0.1, kAhead_s = 12.0, kLead_s = 0.5;
constexpr double kSd_m = 2.0;  // of the target, each axis

// A wall of 50 m, 20 m thick and 100 m long, 500 m east of a camera that is as high as the wall.
double wall(double east_m, double north_m) {
  return std::abs(east_m - 500.0) < 10.0 && std::abs(north_m) < 50.0 ? 50.0 : 0.0;
}

std::vector<Position> straight(const Land& land, const Eigen::Vector3d& from_m,
                               const Eigen::Vector3d& v_m_s) {
  std::vector<Position> path;
  for (double t = 0.0; t < kAhead_s; t += kStep_s) {
    const Eigen::Vector3d p = from_m + t * v_m_s;
    const Eigen::Vector3d p_ecef = land.at(p.x(), p.y(), p.z());
    path.push_back({p_ecef, enu_covariance(p_ecef, {kSd_m, kSd_m, kSd_m})});
  }
  return path;
}

TEST(LandHorizon, ReachesFartherWhenItIsAskedFarther) {
  const auto land = std::make_shared<const Land>(
      [](double east_m, double) { return std::abs(east_m - 3000.0) < 50.0 ? 300.0 : 0.0; });
  LandHorizon horizon(land, {kPlace.latitude_rad, kPlace.longitude_rad, 50.0});
  EXPECT_LT(horizon.highest_before(0.5 * kPi, 300.0)->elevation_rad, 0.0);
  EXPECT_NEAR(horizon.highest_before(0.5 * kPi, 4000.0)->elevation_rad, std::atan2(250.0, 2950.0),
              0.002);
}

TEST(Occlusion, EndsAboveTheCrestAndBesideTheWall) {
  struct Case {
    const char* what;
    Eigen::Vector3d from_m, v_m_s;
    double in_s, sd_s;  // in_s < 0: it does not come out; NaN: it is not hidden
    double azimuth_rad = 0.0;
  };
  const double kNone = std::numeric_limits<double>::quiet_NaN();
  // The edge is half as far as the target: the land's error (1 m) counts twice. So does the
  // outlines', another metre.
  const double land_sd_m = std::hypot(kSd_m, 2.0);
  const Case cases[] = {
      {"in front of the wall", {400.0, 0.0, 10.0}, {0.0, 10.0, 0.0}, kNone, 0.0},
      {"above it", {1000.0, 0.0, 90.0}, {0.0, 10.0, 0.0}, kNone, 0.0},
      {"soon, but not yet", {1000.0, -120.0, 20.0}, {0.0, 10.0, 0.0}, kNone, 0.0},
      {"climbs", {1000.0, 0.0, 20.0}, {0.0, 0.0, 5.0}, 6.0, land_sd_m / 5.0, kPi / 2.0},
      {"passes",
       {1000.0, 20.0, 20.0},
       {0.0, 10.0, 0.0},
       (50.0 / 490.0 * 1000.0 - 20.0) / 10.0,  // the corner that is nearer
       land_sd_m / 10.0,
       std::atan2(490.0, 50.0)},
      {"stays", {1000.0, 0.0, 20.0}, {0.0, 1.0, 0.0}, -1.0, 0.0},
  };
  const auto land = std::make_shared<const Land>(wall);
  LandHorizon horizon(land, {kPlace.latitude_rad, kPlace.longitude_rad, 50.0});
  for (const Case& c : cases) {
    SCOPED_TRACE(c.what);
    const auto found =
        occlusion_ahead(horizon, straight(*land, c.from_m, c.v_m_s), kStep_s, kLead_s);
    ASSERT_EQ(found.has_value(), !std::isnan(c.in_s));
    if (!found) continue;
    EXPECT_GT(found->hidden, 0.95);
    ASSERT_EQ(found->exit.has_value(), c.in_s >= 0.0);
    if (!found->exit) continue;
    EXPECT_NEAR(found->exit->in_s, c.in_s, 0.1);
    EXPECT_NEAR(found->exit->sd_s, c.sd_s, 0.25 * c.sd_s);
    EXPECT_NEAR(found->exit->direction.azimuth_rad, c.azimuth_rad, 1e-3);
    const Eigen::Matrix2d& P = found->exit->covariance;
    EXPECT_GT(P.determinant(), 0.0);
    EXPECT_NEAR(std::sqrt(P(0, 0)), 2e-3,
                1e-3);  // the target's 2 m, or the edge's 1 m, 1000 m away
  }
}

// The target is probably out: what remains is the end.
TEST(Occlusion, IsEndingWhileItMayStillBeHidden) {
  const auto land = std::make_shared<const Land>(wall);
  LandHorizon horizon(land, {kPlace.latitude_rad, kPlace.longitude_rad, 50.0});
  const auto path = straight(*land, {1000.0, 103.5, 20.0}, {0.0, 10.0, 0.0});
  const auto found = occlusion_ahead(horizon, path, kStep_s, kLead_s);
  ASSERT_TRUE(found && found->exit);
  EXPECT_LT(found->hidden, 0.5);
  EXPECT_LT(found->exit->in_s, 0.5);
}

// Two walls with a gap of 4 m, which the target crosses at the double distance. In its middle the
// target is still hidden with a probability of 0.15. The next exit is the gap, not the end of the
// second wall, although the target is more surely hidden behind that.
TEST(Occlusion, EndsAtAGapThatIsProbablyWideEnough) {
  const auto land = std::make_shared<const Land>([](double east_m, double north_m) {
    const bool gap = north_m > 50.0 && north_m < 54.0;
    return std::abs(east_m - 500.0) < 10.0 && north_m > -50.0 && north_m < 150.0 && !gap ? 50.0
                                                                                         : 0.0;
  });
  LandHorizon horizon(land, {kPlace.latitude_rad, kPlace.longitude_rad, 50.0});
  const auto path = straight(*land, {1000.0, 96.5, 20.0}, {0.0, 10.0, 0.0});
  const auto found = occlusion_ahead(horizon, path, kStep_s, kLead_s);
  ASSERT_TRUE(found && found->exit);
  EXPECT_GT(found->hidden, 0.9);
  EXPECT_LT(found->hidden, 1.0);
  EXPECT_NEAR(found->exit->in_s, (50.0 / 490.0 * 1000.0 - 96.5) / 10.0, 0.3);
}

// A house's outline is known to a metre. So what stays 1 m beside a house 50 m away is hidden with
// a probability of 0.16.
TEST(Occlusion, MayBeBehindAHouseThatIsAMetreBesideIt) {
  const auto land = std::make_shared<const Land>([](double east_m, double north_m) {
    return std::abs(east_m - 55.0) < 5.0 && north_m > 1.0 && north_m < 20.0 ? 60.0 : 0.0;
  });
  LandHorizon horizon(land, {kPlace.latitude_rad, kPlace.longitude_rad, 50.0});
  const auto path = straight(*land, {1000.0, 0.0, 60.0}, {-10.0, 0.0, 0.0});
  const auto found = occlusion_ahead(horizon, path, kStep_s, kLead_s);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->hidden, 0.16, 0.06);
}

// The hill 500 m away is 3 sigmas below the target, the roof 55 m away only 1.1: its metre of error
// is nearly a degree. So the roof may hide the target, though the hill is the higher one.
TEST(Occlusion, MayBeBehindANearRoofThatIsLowerThanTheHorizon) {
  const auto height = [](double roof_m) {
    return [roof_m](double east_m, double) {
      if (std::abs(east_m - 55.0) < 5.0) return roof_m;
      return std::abs(east_m - 500.0) < 10.0 ? 52.0 : 0.0;
    };
  };
  for (const auto& [roof_m, hidden] : {std::pair{49.5, 0.13}, std::pair{30.0, 0.0}}) {
    const auto land = std::make_shared<const Land>(height(roof_m));
    LandHorizon horizon(land, {kPlace.latitude_rad, kPlace.longitude_rad, 50.0});
    const auto path = straight(*land, {1000.0, 0.0, 60.5}, {0.0, 1.0, 0.0});
    const auto found = occlusion_ahead(horizon, path, kStep_s, kLead_s);
    EXPECT_NEAR(found ? found->hidden : 0.0, hidden, 0.06) << roof_m;
  }
}

// As behind the wall that the land has, above.
TEST(Occlusion, IsBehindWhatTheStationHasSeen) {
  const auto land = std::make_shared<const Land>(flat);
  LandHorizon horizon(land, {kPlace.latitude_rad, kPlace.longitude_rad, 50.0});
  land::SeenSkyline seen;
  const double edge_rad = std::atan2(490.0, 50.0);
  for (int column = 0; column < land::SeenSkyline::kColumns; ++column) {
    if (std::abs(land::SeenSkyline::azimuth_rad(column) - kPi / 2.0) < kPi / 2.0 - edge_rad)
      seen.set(column, {0.0, 1e-4, 490.0, true});
  }
  const auto path = straight(*land, {1000.0, 20.0, 20.0}, {0.0, 10.0, 0.0});
  EXPECT_FALSE(occlusion_ahead(horizon, path, kStep_s, kLead_s));
  const auto found = occlusion_ahead(horizon, path, kStep_s, kLead_s, {&seen});
  ASSERT_TRUE(found && found->exit);
  EXPECT_GT(found->hidden, 0.95);
  EXPECT_NEAR(found->exit->in_s, (50.0 / 490.0 * 1000.0 - 20.0) / 10.0, 0.5);
  EXPECT_NEAR(found->exit->direction.azimuth_rad, edge_rad, 3e-3);
  const auto before = straight(*land, {400.0, 0.0, 20.0}, {0.0, 1.0, 0.0});
  EXPECT_FALSE(occlusion_ahead(horizon, before, kStep_s, kLead_s, {&seen}));
}

TEST(Occlusion, IsNotOfACameraUnderTheGround) {
  const auto land = std::make_shared<const Land>([](double, double) { return 100.0; });
  LandHorizon horizon(land, {kPlace.latitude_rad, kPlace.longitude_rad, 50.0});
  const auto path = straight(*land, {1000.0, 0.0, 20.0}, {0.0, 10.0, 0.0});
  EXPECT_FALSE(occlusion_ahead(horizon, path, kStep_s, kLead_s));
}

}  // namespace
}  // namespace ols::fusion
