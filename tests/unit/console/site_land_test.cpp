#include "console/site_land.h"

#include <gtest/gtest.h>

#include <cmath>

#include "console/land_skylines.h"
#include "geometry/angles.h"

namespace ols::console {
namespace {

constexpr double kLatitude_deg = 49.2, kLongitude_deg = 16.6, kStep_deg = 0.0005;
constexpr int kHalf = 30, kRidge = 20;  // steps: to each side; to a ridge in the north

// Level land at 300 m with a ridge of 400 m, 1112 m north of the middle.
land::TerrainFolder ridge() {
  constexpr int kSide = 2 * kHalf + 1;
  auto heights_m = std::make_shared<std::vector<float>>(kSide * kSide, 300.0F);
  std::fill_n(heights_m->begin() + std::ptrdiff_t{kHalf - kRidge} * kSide, kSide, 400.0F);
  const land::HeightGrid grid{radians(kLatitude_deg + kHalf * kStep_deg),
                              radians(kLongitude_deg - kHalf * kStep_deg),
                              radians(kStep_deg),
                              radians(kStep_deg),
                              kSide,
                              kSide,
                              1.0,
                              *heights_m};
  land::TerrainFolder folder;
  folder.version = "0123456789ab";
  folder.terrain = std::make_shared<const land::Terrain>(std::vector{grid},
                                                         std::vector<land::Covering>(), heights_m);
  return folder;
}

class SiteLandTest : public testing::Test {
 protected:
  static Geodetic camera(double height_m = 310.0) {
    return {radians(kLatitude_deg), radians(kLongitude_deg), height_m};
  }
  Json ask(std::string_view path, std::string_view query, int status = 200) {
    return said(*land_task(path, query), status);
  }
  Json ask_of_alfa(std::string_view what, std::string_view query, const Geodetic& at,
                   int status = 200) {
    return said(*land_task(what, query, "alfa", at), status);
  }
  Json said(const LandTask& task, int status) {
    const WebResponse response = land_.answer(task);
    EXPECT_EQ(response.status, status) << response.body;
    return Json::parse(response.body);
  }
  SiteLand land_{ridge()};
};

TEST_F(SiteLandTest, ASkylineIsComputedOnceForEachPlaceOfACameraAndNobodyWaitsForIt) {
  LandSkylines skylines("0123456789ab", ridge().terrain);
  const auto ask_at = [&](double height_m) {
    return skylines.answer(*land_task("skyline", "", "alfa", camera(height_m)));
  };
  const auto compute = [&](double height_m) {
    const LandTask task = *land_task("skyline", "", "alfa", camera(height_m));
    skylines.keep(task, skylines.compute(task));
  };
  const auto status = [&](double height_m) { return ask_at(height_m).response.status; };
  EXPECT_TRUE(ask_at(310.0).begins);
  for (int browser = 0; browser < 20; ++browser) EXPECT_FALSE(ask_at(310.0).begins);
  EXPECT_EQ(status(310.0), 202);
  compute(310.0);
  EXPECT_EQ(status(310.5), 200);
  const Json skyline = Json::parse(ask_at(310.0).response.body);
  EXPECT_EQ(skyline.at("version"), "0123456789ab");
  const Json& elevations = skyline.at("elevation_deg");
  ASSERT_EQ(elevations.size(), 7200U);
  EXPECT_NEAR(elevations.at(0), degrees(std::atan2(90.0, 1112.2)), 0.01);
  EXPECT_NEAR(elevations.at(3600), degrees(std::atan2(-10.0, 1668.0)), 0.01);  // where it ends
  EXPECT_TRUE(ask_at(312.0).begins) << "a camera that has moved";
  EXPECT_FALSE(ask_at(200.0).begins) << "one at a time";
  skylines.keep(*land_task("skyline", "", "alfa", camera(312.0)), WebResponse{.status = 500});
  EXPECT_TRUE(ask_at(312.0).begins) << "what failed is tried again";
  compute(312.0);
  EXPECT_TRUE(ask_at(200.0).begins);
  EXPECT_EQ(status(200.0), 202);
  compute(200.0);
  const WebResponse refusal = ask_at(200.0).response;
  EXPECT_EQ(refusal.status, 409);
  const Json refused = Json::parse(refusal.body);
  EXPECT_EQ(refused.at("refusal").at("id"), "land_does_not_fit");
  EXPECT_NE(std::string(refused.at("error")).find("100 m under the ground"), std::string::npos);
}

TEST_F(SiteLandTest, TheLandBelowALineOfSightAndWhereItIsBlocked) {
  const double edge_m = 1668.0;  // of the model, in the north and the south
  struct {
    const char* to;
    double blocked_m, known_m;  // 0: nowhere; all of it
  } const cases[]{{"?to=49.213,16.6,350", 1112.0, 0.0}, {"?to=49.213,16.6,450", 0.0, 0.0},
                  {"?to=49.213,16.6", 1112.0, 0.0},     {"?to=49.205,16.6", 0.0, 0.0},
                  {"?to=49.18,16.6,330", 0.0, edge_m},  {"?to=49.22,16.6,350", 1112.0, edge_m}};
  for (const auto& [to, blocked_m, known_m] : cases) {
    const Json profile = ask_of_alfa("profile", to, camera());
    const Json& points = profile.at("points");
    EXPECT_NEAR(points.front().at(3), 310.0, 0.1) << to;
    EXPECT_NEAR(profile.at("blocked_m").is_null() ? 0.0 : double{profile.at("blocked_m")},
                blocked_m, 56.0)
        << to;
    const Json& known_to_m = profile.at("known_to_m");
    EXPECT_NEAR(known_to_m.is_null() ? 0.0 : double{known_to_m}, known_m, 56.0) << to;
  }
  const Json points = ask_of_alfa("profile", "?to=49.213,16.6,450", camera()).at("points");
  EXPECT_NEAR(points.back().at(0), 1446.0, 2.0);
  EXPECT_NEAR(points.back().at(3), 450.0, 0.1);
  EXPECT_NEAR(points.at(points.size() / 2).at(3), 380.0, 0.1);  // refraction and curvature: 5 cm
  EXPECT_EQ(points.front().at(1), 300.0);
}

TEST_F(SiteLandTest, HeightsOfTheGround) {
  EXPECT_EQ(ask("/api/land/ground", "?at=49.2,16.6").at("ground_m"), 300.0);
  EXPECT_EQ(ask("/api/land/ground", "?at=49.21,16.6").at("top_m"), 400.0);
  EXPECT_EQ(ask("/api/land/ground", "?at=49.3,16.6").at("ground_m"), nullptr);
  const Json heights = ask("/api/land/heights", "?box=16.59,49.2,16.61,49.3").at("heights_m");
  ASSERT_EQ(heights.size(), std::size_t{SiteLand::kHeightsAcross} * SiteLand::kHeightsAcross);
  EXPECT_EQ(heights.front(), nullptr) << "the north is not known";
  EXPECT_EQ(heights.back(), 300.0);
}

TEST_F(SiteLandTest, WhatDoesNotFitIsNamed) {
  ask_of_alfa("profile", "?to=49.2,16.6,400", camera(), 409);
  ask_of_alfa("profile", "?to=49.5,16.6", camera(), 409);
}

TEST_F(SiteLandTest, ASiteWithoutLandSaysSo) {
  land_ = SiteLand({});
  EXPECT_EQ(ask("/api/land", "").at("version"), nullptr);
  ask("/api/land/ground", "?at=1,1", 404);
}

TEST(LandTask, WhatIsNoQuestionIsNone) {
  for (const char* query : {"", "?at=91,0", "?at=1", "?at=1,2,3", "?at=a,b"}) {
    EXPECT_FALSE(land_task("/api/land/ground", query)) << query;
  }
  for (const char* query : {"", "?box=1,2,3", "?box=2,2,1,3", "?box=0,0,10,1", "?box=0,89,1,91"}) {
    EXPECT_FALSE(land_task("/api/land/heights", query)) << query;
  }
  EXPECT_FALSE(land_task("profile", "?to=1", "alfa", {}));
  EXPECT_FALSE(land_task("profile", "?to=1,2,1e9", "alfa", {}));
  EXPECT_FALSE(land_task("panorama", "?to=1,2", "alfa", {}));
}

TEST(LandTask, ACameraWithoutAPlaceHasNone) {
  EXPECT_FALSE(camera_of({{"id", "alfa"}}));
  EXPECT_FALSE(camera_of({{"camera_ecef_m", {nullptr, nullptr, nullptr}}}));
  EXPECT_FALSE(camera_of({{"camera_ecef_m", {0.0, 0.0, 0.0}}}));
  const Eigen::Vector3d p = ecef_from_geodetic({0.8, 0.3, 200.0});
  EXPECT_NEAR(camera_of({{"camera_ecef_m", {p.x(), p.y(), p.z()}}})->height_m, 200.0, 1e-6);
}

}  // namespace
}  // namespace ols::console
