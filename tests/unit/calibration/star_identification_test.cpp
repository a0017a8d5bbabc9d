#include "calibration/star_identification.h"

#include <gtest/gtest.h>

#include "tests/unit/calibration/star_scene.h"

namespace ols::calibration {
namespace {

using test::conditions_of;
using test::night_sky;
using test::NightSky;
using Verdict = StarIdentification::Verdict;

constexpr std::uint64_t kSeed = 1002;

StarIdentification identified(const NightSky& sky) {
  return identify_stars(sky.station, sky.frames, conditions_of(sky));
}

// Three frames of ten stars and five false detections each, tilted by half a degree, any heading.
TEST(StarIdentification, FindsTheStarsAndTheHeading) {
  constexpr int kSkies = 20;
  int found = 0;
  for (int i = 0; i < kSkies; ++i) {
    const NightSky sky = night_sky(kSeed + static_cast<std::uint64_t>(i));
    const StarIdentification one = identified(sky);
    if (one.verdict != Verdict::kIdentified) continue;
    ++found;
    EXPECT_LE(wrong_names(sky, one), 1) << "seed " << kSeed + i;
    const double off_rad = one.heading_rad - sky.truth.geometry.chain.heading_rad;
    EXPECT_NEAR(wrap_pi(off_rad), 0.0, 0.01);  // it is exchangeable with the mounting
  }
  EXPECT_GE(found, kSkies - 1);
}

TEST(StarIdentification, AcceptsNoFalseDetections) {
  NightSky sky = night_sky(kSeed, {.stars = 0, .false_detections = 15});
  const StarIdentification none = identified(sky);
  EXPECT_EQ(none.verdict, Verdict::kTooFewMatched);
  EXPECT_TRUE(none.stars.empty());
  EXPECT_LT(none.matched, 8U);
  EXPECT_EQ(explain_unidentified(sky.station, sky.frames, conditions_of(sky)), "");
}

TEST(StarIdentification, SaysThatThereAreClouds) {
  const StarIdentification one = identified(night_sky(kSeed, {.stars = 2, .false_detections = 1}));
  EXPECT_EQ(one.verdict, Verdict::kTooFewDetections);
  EXPECT_NE(one.finding.find("clouds"), std::string::npos);
}

TEST(StarIdentification, NamesTheWrongHemisphere) {
  NightSky sky = night_sky(kSeed);
  ASSERT_EQ(identified(sky).verdict, Verdict::kIdentified);
  sky.station.model.geometry.position.latitude_rad *= -1.0;
  EXPECT_EQ(identified(sky).verdict, Verdict::kTooFewMatched);
  EXPECT_EQ(explain_unidentified(sky.station, sky.frames, conditions_of(sky)),
            "the stars are those of latitude 49.20, longitude 16.60 deg: is the sign of the "
            "position wrong?");
}

TEST(StarIdentification, NamesAClockThatIsAnHourFast) {
  NightSky sky = night_sky(kSeed);
  for (StarFrame& frame : sky.frames) frame.utime_us += 3'600'000'000;
  EXPECT_EQ(identified(sky).verdict, Verdict::kTooFewMatched);
  EXPECT_EQ(explain_unidentified(sky.station, sky.frames, conditions_of(sky)),
            "the stars are those of 1 h earlier: is the clock UTC?");
}

// By eight frames, of a lens whose distortion the workshop has found; three tell it to 1e-4 only.
TEST(StarIdentification, NamesALensThatWasRefocused) {
  NightSky sky = night_sky(kSeed, {.frames = 8});
  CameraIntrinsics& camera = sky.station.model.geometry.camera;
  sky.station.covariance(kFocal, kFocal) = std::pow(1e-4 * camera.fx_px, 2);
  sky.station.covariance(kK1, kK1) = std::pow(0.005, 2);
  camera.k1 = sky.truth.geometry.camera.k1;
  camera.fx_px = sky.truth.geometry.camera.fx_px;
  camera.fy_px = sky.truth.geometry.camera.fy_px;
  EXPECT_EQ(identified(sky).finding.find("refocused"), std::string::npos);
  camera.fx_px *= 1.0007;
  camera.fy_px *= 1.0007;
  const StarIdentification one = identified(sky);
  EXPECT_NEAR(one.focal_change, -7e-4, 3.0 * one.focal_sd);
  EXPECT_NE(one.finding.find("was the lens refocused?"), std::string::npos) << one.finding;
}

}  // namespace
}  // namespace ols::calibration
