// An overview station: what it says of its zoom, and what its bearings are worth.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "station_fixture.h"

namespace ols::station {
namespace {

ZoomPoint point(double position, double focal_px) {
  ZoomPoint p;
  p.position = position;
  p.camera.fx_px = p.camera.fy_px = focal_px;
  p.focal_sd_px = 0.01 * focal_px;
  p.centre_sd_px = 2.0;
  return p;
}

class OverviewTest : public test::StationTest {
 protected:
  OverviewTest() : overview_(config(), std::make_unique<test::ScriptedTracker>(script_)) {
    overview_.set_reference(mount::Reference::kTrusted);
  }
  static StationConfig config() {
    StationConfig config = test::StationTest::config();
    config.overview = true;
    config.zoom.emplace(ZoomTable({point(0.0, 2000.0), point(1.0, 20000.0)}), 0.0);
    return config;
  }

  // A designated target at this pixel for a second, with the zoom there; the last bearing.
  std::optional<Bearing> follow(const Eigen::Vector2d& pixel, std::optional<double> zoom) {
    script_.pixel = pixel;
    std::optional<Bearing> last;
    bool designated = false;
    const double end_s = now_ + 1.0;
    while (now_ < end_s) {
      now_ += 0.02;
      overview_.on_angles(sample());
      if (zoom) overview_.on_zoom({now_ - 0.005, 0.005, *zoom});
      camera::Frame frame;
      frame.mid_exposure_s = now_ - 0.01;
      overview_.on_frame(frame);
      if (!designated) overview_.designate({std::nullopt, {629, 469, 20, 20}}, now_);
      designated = true;
      for (const auto& bearing : overview_.step(now_).bearings) last = bearing;
    }
    return last;
  }

  Station overview_;
};

double largest_sd(const Bearing& bearing) {
  return std::sqrt(bearing.sight.covariance_systematic.diagonal().maxCoeff());
}

TEST_F(OverviewTest, SaysItsFocalLengthAndWhatThatIsWorth) {
  EXPECT_TRUE(overview_.snapshot().overview);
  EXPECT_FALSE(overview_.snapshot().focal_length_px) << "the lens has not spoken";
  follow({639.5, 479.5}, 0.5);
  const StationSnapshot snapshot = overview_.snapshot();
  EXPECT_NEAR(*snapshot.focal_length_px, std::sqrt(2000.0 * 20000.0), 1e-6);
  EXPECT_NEAR(snapshot.focal_length_sd_px, 0.01 * *snapshot.focal_length_px, 1e-6);
}

// The direction of a pixel is that of the zoom at its exposure, and its deviation grows with the
// distance from the principal point, where the focal length counts.
TEST_F(OverviewTest, ItsBearingsAreThoseOfItsZoomWithAnHonestDeviation) {
  const auto wide = follow({1139.5, 479.5}, 0.0);
  ASSERT_TRUE(wide);
  const double heading_rad = config().geometry.chain.heading_rad;
  EXPECT_NEAR(wide->sight.direction.azimuth_rad - heading_rad, std::atan(500.0 / 2000.0), 1e-6);
  EXPECT_NEAR(largest_sd(*wide), 0.01 * 500.0 / 2000.0, 4e-4);
}

TEST_F(OverviewTest, AtTheMiddleOfThePictureOnlyThePrincipalPointCounts) {
  const auto middle = follow({639.5, 479.5}, 0.0);
  ASSERT_TRUE(middle);
  EXPECT_NEAR(largest_sd(*middle), std::hypot(2.0 / 2000.0, 1.0 / 2000.0, radians(0.02)), 2e-5);
}

TEST_F(OverviewTest, WithoutItsZoomItSendsNoBearings) {
  EXPECT_FALSE(follow({639.5, 479.5}, std::nullopt));
  EXPECT_FALSE(overview_.video_frame(now_ - 0.01)->camera);
}

TEST_F(OverviewTest, ItsVideoCarriesTheCameraOfItsZoom) {
  follow({639.5, 479.5}, 1.0);
  const auto frame = overview_.video_frame(now_ - 0.01);
  ASSERT_TRUE(frame && frame->camera);
  EXPECT_NEAR(frame->camera->intrinsics.fx_px, 20000.0, 1e-6);
}

TEST_F(OverviewTest, IsNotSlewedByTheFusion) {
  EXPECT_EQ(overview_.slew(slew(30.0), now_), Refusal::kOverview);
}

TEST_F(OverviewTest, OrdersToTheLensAreJudgedAndHandedOnOnce) {
  LensCommand command;
  command.values.zoom = 0.5;
  EXPECT_EQ(overview_.lens(command, now_), Refusal::kNone);
  command = {};
  command.is_rate = true;
  command.values.focus = -0.5;
  command.received_s = now_;
  command.lease_s = 0.3;
  EXPECT_EQ(overview_.lens(command, now_), Refusal::kNone);
  const UnitActions actions = overview_.take_actions();
  EXPECT_EQ(actions.lens.axes.zoom->position, 0.5);
  EXPECT_EQ(actions.lens.axes.focus->rate, -0.5);
  EXPECT_NEAR(actions.lens.axes.focus->until_s, now_ + 0.3, 1e-12);
  EXPECT_FALSE(actions.lens.axes.iris);
  EXPECT_FALSE(overview_.take_actions().lens.axes.zoom);
}

TEST_F(OverviewTest, SpoiltOrdersToTheLensAreRefused) {
  LensCommand command;
  command.values.zoom = 1.5;
  EXPECT_EQ(overview_.lens(command, now_), Refusal::kOutOfRange);
  command.values.zoom = -0.5;
  EXPECT_EQ(overview_.lens(command, now_), Refusal::kOutOfRange) << "no rate";
  command.is_rate = true;
  command.lease_s = 2.0;
  EXPECT_EQ(overview_.lens(command, now_), Refusal::kOutOfRange);
  command.lease_s = std::nan("");
  EXPECT_EQ(overview_.lens(command, now_), Refusal::kNotFinite);
  command.lease_s = 0.3;
  command.values.zoom = -1.0 / 0.0;
  EXPECT_EQ(overview_.lens(command, now_), Refusal::kNotFinite);
  EXPECT_EQ(station_.lens({}, now_), Refusal::kNoLens);
  EXPECT_FALSE(overview_.take_actions().lens.axes.zoom);
}

}  // namespace
}  // namespace ols::station
