#include "edge/skyline/skyline_watch.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <stdexcept>

#include "sim/world/panorama.h"
#include "tests/unit/edge/skyline/made_site.h"

namespace ols::skyline {
namespace {

constexpr double kWrong_rad = radians(0.3);
constexpr double kHigh_rad = radians(1.5);  // of an obstacle above the land

CameraIntrinsics wide_camera() {
  CameraIntrinsics camera;
  camera.width_px = 640;
  camera.height_px = 480;
  camera.cx_px = 319.5;
  camera.cy_px = 239.5;
  camera.fx_px = camera.fy_px = 1500.0;
  return camera;
}

Eigen::Matrix3d R_enu_cam(double azimuth_rad) {
  Eigen::Matrix3d R;
  R << std::cos(azimuth_rad), 0.0, std::sin(azimuth_rad),  //
      -std::sin(azimuth_rad), 0.0, std::cos(azimuth_rad),  //
      0.0, -1.0, 0.0;
  return R;
}

// What a station states.
struct Stated {
  Geodetic place;
  double wrong_rad = 0.0;  // its heading is off by this
  double azimuth_sd_rad = radians(0.01), position_sd_m = 0.5;
};

// A station that turns around and looks at the true land; the watch knows the model of it.
class SkylineWatchTest : public ::testing::Test {
 protected:
  static sim::Panorama drawn_land() {
    sim::Panorama panorama(landscape(), wide_camera(),
                           sim::slopes_texture(landscape(), wide_camera()), 4);
    panorama.raise([](double azimuth_rad) {
      const auto skyline = truth_.skyline(azimuth_rad);
      return skyline ? skyline->elevation_rad : -0.5;
    });
    return panorama;
  }

  static sim::Landscape landscape() {
    sim::Landscape landscape;
    landscape.ridge_mean_rad = radians(-40.0);
    landscape.ridge_relief_rad = 0.0;
    return landscape;
  }

  void turn_around(const Stated& stated) {
    for (double deg = 0.0; deg < 360.0; deg += 20.0) look(deg, stated);
  }
  void look(double azimuth_deg, const Stated& stated) {
    StatedPicture picture;
    picture.mid_exposure_s = time_s_ += 5.0;
    picture.utime_us = 1'700'000'000'000'000 + std::llround(1e6 * time_s_);
    panorama_.draw(R_enu_cam(radians(azimuth_deg)), picture.gray);
    picture.camera = {
        ecef_from_geodetic(stated.place),
        (LocalFrame(stated.place).R_ecef_enu() * R_enu_cam(radians(azimuth_deg) + stated.wrong_rad))
            .transpose(),
        wide_camera()};
    picture.azimuth_sd_rad = stated.azimuth_sd_rad;
    picture.position_sd_enu_m.setConstant(stated.position_sd_m);
    watch_.look(picture);
  }
  Geodetic moved(double east_m) const {
    return geodetic_from_ecef(LocalFrame(site_.camera()).to_ecef({east_m, 0.0, 0.0}));
  }
  // So far below the model's ground.
  Geodetic under_ground(double by_m) const {
    Geodetic place = site_.camera();
    place.height_m = site_.model().ground(place.latitude_rad, place.longitude_rad)->height_m - by_m;
    return place;
  }
  // Stands before the land from now on, as high as this above its skyline.
  void build(double azimuth_deg, double width_deg, double high_rad) {
    panorama_.raise([=](double azimuth_rad) {
      const bool is_there =
          std::abs(wrap_pi(azimuth_rad - radians(azimuth_deg))) < radians(width_deg) / 2.0;
      const auto skyline = truth_.skyline(azimuth_rad);
      return is_there && skyline ? skyline->elevation_rad + high_rad : -0.5;
    });
  }
  // In the direction of 100 degrees, until it counts.
  void see_obstacle() {
    build(100.0, 2.0, kHigh_rad);
    for (int picture = 0; picture < SkylineWatch::kPictures; ++picture) {
      look(100.0, {site_.camera()});
      time_s_ += SkylineWatch::kApart_s / 2.0;
    }
  }
  std::optional<land::SeenCrest> crest(double azimuth_deg) const {
    return watch_.hiding().crests.at(radians(azimuth_deg));
  }
  bool says(const std::string& words) const {
    return watch_.alarm().text.find(words) != std::string::npos;
  }

  static inline const MadeSite site_{4};
  static inline const land::HorizonMap truth_{site_.truth(), site_.camera(), quick_map()};
  static inline const sim::Panorama land_ = drawn_land();
  sim::Panorama panorama_ = land_;
  SkylineWatch watch_{std::make_shared<land::MadeLand>(site_.model()), quick_map()};
  double time_s_ = 0.0;
};

TEST_F(SkylineWatchTest, AWrongHeadingIsNoticedAndARightOneIsNot) {
  turn_around({site_.camera()});
  ASSERT_TRUE(watch_.heading().has_value());
  EXPECT_TRUE(watch_.alarm().empty());
  watch_.forget();
  EXPECT_FALSE(watch_.heading().has_value());
  turn_around({site_.camera(), kWrong_rad});
  EXPECT_NEAR(watch_.heading()->error_rad, kWrong_rad, 4.0 * watch_.heading()->sd_rad);
  EXPECT_TRUE(says("heading: disagrees with the skyline of the land by +0."));
  watch_.forget();
  EXPECT_TRUE(watch_.alarm().empty());
}

TEST_F(SkylineWatchTest, AnErrorThatTheStationStatesIsNoNews) {
  turn_around({.place = site_.camera(), .wrong_rad = kWrong_rad, .azimuth_sd_rad = radians(0.1)});
  ASSERT_TRUE(watch_.heading().has_value());
  EXPECT_NEAR(watch_.heading()->error_rad, kWrong_rad, 4.0 * watch_.heading()->sd_rad);
  EXPECT_GT(watch_.difference_sd_rad(), radians(0.1));
  EXPECT_TRUE(watch_.alarm().empty());
}

// Hills on one side only, seen from a place beside the stated one: it looks like another heading.
TEST_F(SkylineWatchTest, AnErrorOfThePositionCountsAsWhatIsStatedOfIt) {
  constexpr double kOff_m = 100.0;
  const auto look_east = [this](const Stated& stated) {
    watch_.forget();
    for (double deg = 60.0; deg < 130.0; deg += 10.0) look(deg, stated);
    ASSERT_TRUE(watch_.heading().has_value());
  };
  look_east({.place = site_.camera(), .position_sd_m = 0.5});
  const double exact_rad = watch_.heading()->sd_rad;
  look_east({.place = moved(kOff_m), .position_sd_m = kOff_m});
  EXPECT_GT(watch_.heading()->sd_rad, 1.2 * exact_rad);
  EXPECT_TRUE(watch_.alarm().empty());
}

TEST_F(SkylineWatchTest, AKnockedTripodIsNoticedAfterALongTimeInPlace) {
  for (int round = 0; round < 8; ++round) turn_around({site_.camera()});
  EXPECT_TRUE(watch_.alarm().empty());
  for (int round = 0; round < 4; ++round) turn_around({site_.camera(), kWrong_rad});
  EXPECT_TRUE(says("disagrees"));
  for (int round = 0; round < 8; ++round) turn_around({site_.camera()});
  EXPECT_TRUE(watch_.alarm().empty());
}

TEST_F(SkylineWatchTest, AnAlarmEndsWithWhatItIsFrom) {
  turn_around({site_.camera(), kWrong_rad});
  EXPECT_TRUE(watch_.disagrees());
  time_s_ += SeenHorizon::kMemory_s;
  cv::Mat fog(480, 640, CV_8U, cv::Scalar(190));
  StatedPicture picture;
  picture.mid_exposure_s = time_s_ += 200.0;
  picture.gray = fog;
  picture.camera = {ecef_from_geodetic(site_.camera()),
                    (LocalFrame(site_.camera()).R_ecef_enu() * R_enu_cam(0.0)).transpose(),
                    wide_camera()};
  watch_.look(picture);
  EXPECT_FALSE(watch_.heading().has_value());
  EXPECT_TRUE(watch_.alarm().empty());
}

TEST_F(SkylineWatchTest, WhatNoModelHasIsSeenAndHides) {
  look(100.0, {site_.camera()});
  ASSERT_TRUE(crest(100.0));
  EXPECT_FALSE(crest(100.0)->disagrees);
  EXPECT_GT(crest(100.0)->hides_from_m, 0.0);
  build(100.0, 2.0, kHigh_rad);
  for (int i = 0; i < 30; ++i) look(100.0, {site_.camera()});
  const double truth_rad = truth_.skyline(radians(100.0))->elevation_rad + kHigh_rad;
  EXPECT_NEAR(crest(100.0)->elevation_rad, truth_rad, radians(0.1));
  EXPECT_TRUE(crest(100.0)->disagrees);
  EXPECT_GT(crest(100.0)->hides_from_m, 0.0);
  EXPECT_LE(crest(100.0)->hides_from_m, truth_.skyline(radians(100.0))->distance_m * 1.05);
  EXPECT_FALSE(crest(97.0)->disagrees);
}

// A cloud above the skyline is such a thing: its edge stays nowhere.
TEST_F(SkylineWatchTest, WhatIsHigherHidesOnlyAfterThreePicturesInTwoMinutes) {
  look(100.0, {site_.camera()});
  build(100.0, 2.0, kHigh_rad);
  for (int picture = 0; picture < 4; ++picture) look(100.0, {site_.camera()});
  EXPECT_FALSE(crest(100.0)->disagrees) << "four within seconds";
  time_s_ += SkylineWatch::kApart_s;
  look(100.0, {site_.camera()});
  EXPECT_TRUE(crest(100.0)->disagrees);
}

TEST_F(SkylineWatchTest, TwoPicturesAreTooFewHoweverFarApart) {
  build(100.0, 2.0, kHigh_rad);
  look(100.0, {site_.camera()});
  time_s_ += SkylineWatch::kApart_s;
  look(100.0, {site_.camera()});
  EXPECT_FALSE(crest(100.0));
}

TEST_F(SkylineWatchTest, WhatIsHigherHidesNothingWhereEachPictureShowsItElsewhere) {
  for (int picture = 0; picture < 4; ++picture) {
    build(100.0, 2.0, kHigh_rad + radians(0.3) * picture - radians(1.0));
    look(100.0, {site_.camera()});
    time_s_ += SkylineWatch::kApart_s;
    EXPECT_FALSE(crest(100.0)) << picture;
  }
}

TEST_F(SkylineWatchTest, WhatIsHigherIsKeptForADayOrUntilTheLandIsSeenThere) {
  see_obstacle();
  time_s_ += 0.9 * SkylineWatch::kKept_s;
  look(200.0, {site_.camera()});
  EXPECT_TRUE(crest(100.0));
  time_s_ += 0.2 * SkylineWatch::kKept_s;
  look(200.0, {site_.camera()});
  EXPECT_FALSE(crest(100.0));
  see_obstacle();
  ASSERT_TRUE(crest(100.0)->disagrees);
  panorama_ = land_;
  look(100.0, {site_.camera()});
  EXPECT_FALSE(crest(100.0)->disagrees);
}

TEST_F(SkylineWatchTest, WhatHasBeenSeenIsKeptUntilItIsForgottenOrTheStationMoves) {
  look(100.0, {site_.camera()});
  const auto begun_us = watch_.hiding().begun_us;
  EXPECT_NE(begun_us, 0);
  time_s_ += 10.0 * SeenHorizon::kMemory_s;
  look(200.0, {site_.camera()});
  EXPECT_TRUE(crest(100.0) && crest(200.0));
  EXPECT_EQ(watch_.hiding().begun_us, begun_us);
  look(200.0, {.place = moved(20.0)});
  EXPECT_FALSE(crest(100.0));
  EXPECT_TRUE(crest(200.0));
  EXPECT_GT(watch_.hiding().begun_us, begun_us);
  watch_.forget();
  EXPECT_TRUE(watch_.hiding().crests.empty());
  EXPECT_EQ(watch_.hiding().begun_us, 0);
}

TEST_F(SkylineWatchTest, AnEarlierSkylineIsResumedOnlyAtItsPlace) {
  look(100.0, {site_.camera()});
  const HidingSkyline earlier = watch_.hiding();
  for (const double away_m : {0.0, 20.0}) {
    watch_ = SkylineWatch(std::make_shared<land::MadeLand>(site_.model()), quick_map());
    watch_.resume(earlier);
    watch_.forget();                      // as at a start, when the mount's reference becomes known
    look(100.0, {.place = moved(50.0)});  // a first fix
    look(200.0, {.place = moved(away_m)});
    EXPECT_EQ(crest(100.0).has_value(), away_m == 0.0);
    EXPECT_TRUE(crest(200.0));
  }
}

TEST_F(SkylineWatchTest, AnEarlierSkylineIsNotResumedOnceThatOfAnotherSetupIsForgotten) {
  look(100.0, {site_.camera()});
  const HidingSkyline earlier = watch_.hiding();
  watch_.resume(earlier);
  look(200.0, {.place = moved(50.0)});
  watch_.forget();
  look(200.0, {site_.camera()});
  EXPECT_FALSE(crest(100.0));
}

TEST_F(SkylineWatchTest, APlaceUnderTheGroundIsSaid) {
  Geodetic under = site_.camera();
  under.height_m -= 120.0;
  turn_around({under});
  EXPECT_TRUE(says("under the ground"));
  turn_around({site_.camera()});  // a right position is taken
  EXPECT_TRUE(watch_.alarm().empty());
  EXPECT_TRUE(watch_.heading().has_value());
}

TEST_F(SkylineWatchTest, UnderTheGroundIsOnlyWhatTheStationsErrorsCannotExplain) {
  static_assert(kModelSd_m == 4.0);  // with 3 m, 15 m are three sigmas
  look(0.0, {.place = under_ground(14.0), .position_sd_m = 3.0});
  EXPECT_FALSE(says("under the ground"));
  look(0.0, {.place = under_ground(20.0), .position_sd_m = 3.0});
  EXPECT_TRUE(says("under the ground"));
}

TEST_F(SkylineWatchTest, APlaceUnderTheGroundIsTriedAgainAsSoonAsItHasMoved) {
  look(0.0, {.place = under_ground(13.0)});
  EXPECT_TRUE(says("13 m under the ground"));
  look(0.0, {.place = under_ground(12.7)});
  EXPECT_TRUE(says("under the ground"));
  look(0.0, {.place = under_ground(11.0)});
  EXPECT_FALSE(says("under the ground"));
}

TEST_F(SkylineWatchTest, WhyThereIsNoMapIsSaidAsLongAsThereIsNone) {
  const auto broken = [](double, double) -> double { throw std::runtime_error("no memory"); };
  watch_ = SkylineWatch(std::make_shared<land::MadeLand>(broken), quick_map());
  for (int picture = 0; picture < 2; ++picture) {
    look(0.0, {site_.camera()});
    EXPECT_TRUE(says("no memory"));
  }
}

// Heights above the ellipsoid, taken as above the geoid, or the reverse.
TEST_F(SkylineWatchTest, ALandWithAnotherZeroOfHeightsIsSaid) {
  Geodetic high = site_.camera();
  high.height_m += 30.0;
  turn_around({high});
  EXPECT_TRUE(says("m higher than its folder says")) << watch_.alarm().text;
  ASSERT_TRUE(watch_.height());
  EXPECT_NEAR(watch_.height()->higher_m, -30.0, 6.0);
  EXPECT_FALSE(watch_.disagrees());
  high.height_m = site_.camera().height_m - 30.0;
  turn_around({high});
  EXPECT_TRUE(says("skyline: the land is -")) << watch_.alarm().text;
}

TEST_F(SkylineWatchTest, AHeightThatTheStationDoesNotKnowIsNoNews) {
  Geodetic high = site_.camera();
  high.height_m += 30.0;
  turn_around({.place = high, .position_sd_m = 20.0});
  EXPECT_TRUE(watch_.alarm().empty()) << watch_.alarm().text;
}

}  // namespace
}  // namespace ols::skyline
