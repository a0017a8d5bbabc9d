#include "edge/skyline/skyline_finder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "dev/bench/drawn_skyline.h"
#include "geometry/angles.h"
#include "sim/world/renderer.h"

namespace ols::skyline {
namespace {

// A picture, and the row of its skyline in each strip.
struct Rendered {
  cv::Mat gray;
  std::vector<double> row_px;
};

// A station of fig7.toml under another sky.
class Scene {
 public:
  Scene(double cloudiness, double haze)
      : world_(scenario(cloudiness, haze), 3),
        renderer_(world_, 0,
                  sim::slopes_texture(world_.scenario().landscape, world_.scenario().camera)) {}

  Rendered render(double azimuth_deg) {
    const StationGeometry& station = world_.stations()[0].truth;
    const double azimuth_rad = radians(azimuth_deg);
    sim::ExposureTruth exposure;
    exposure.mid =
        aim_along(station, {azimuth_rad, renderer_.panorama().ridge_rad(azimuth_rad)}).value();
    exposure.start = exposure.end = exposure.mid;
    Rendered rendered;
    renderer_.draw(exposure, rendered.gray);
    rendered.row_px = bench::drawn_rows(renderer_.panorama());
    return rendered;
  }

 private:
  static sim::Scenario scenario(double cloudiness, double haze) {
    sim::Scenario scenario = sim::load_scenario(std::string(OLS_SCENARIOS) + "/fig7.toml");
    scenario.landscape.cloudiness = cloudiness;
    scenario.landscape.haze = haze;
    return scenario;
  }

  sim::World world_;
  sim::Renderer renderer_;
};

// As of a model without trees, of a station whose heading and tilt are not quite right.
Rows expected_near(const std::vector<double>& row_px) {
  constexpr int kSmooth = 50;
  constexpr double kOff_px = 14.0, kWave_px = 10.0, kSd_px = 25.0;
  Rows expected;
  const auto strips = static_cast<int>(row_px.size());
  for (int strip = 0; strip < strips; ++strip) {
    const int from = std::max(0, strip - kSmooth), to = std::min(strips, strip + kSmooth + 1);
    double sum_px = 0.0;
    for (int i = from; i < to; ++i) sum_px += row_px[static_cast<std::size_t>(i)];
    expected.push_back(
        Row{sum_px / (to - from) + kOff_px + kWave_px * std::sin(strip / 60.0), kSd_px});
  }
  return expected;
}

struct Score {
  double share = 0.0, rms_px = 0.0, rms_sd = 0.0;
};

Score score(const Rows& found, const std::vector<double>& truth_px) {
  Score score;
  int count = 0;
  for (std::size_t strip = 0; strip < found.size(); ++strip) {
    if (!found[strip]) continue;
    ++count;
    const double off_px = found[strip]->at_px - truth_px[strip];
    score.rms_px += off_px * off_px;
    score.rms_sd += std::pow(off_px / found[strip]->sd_px, 2);
  }
  score.share = static_cast<double>(count) / static_cast<double>(found.size());
  score.rms_px = std::sqrt(score.rms_px / count);
  score.rms_sd = std::sqrt(score.rms_sd / count);
  return score;
}

struct Air {
  double cloudiness, haze;
};

class SkylineFinderTest : public ::testing::TestWithParam<Air> {};

TEST_P(SkylineFinderTest, FindsItInNearlyAllColumns) {
  Scene scene(GetParam().cloudiness, GetParam().haze);
  for (const double azimuth_deg : {20.0, 47.0, 130.0, 250.0}) {
    SCOPED_TRACE(azimuth_deg);
    const Rendered rendered = scene.render(azimuth_deg);
    const Score s =
        score(find_skyline(rendered.gray, expected_near(rendered.row_px)), rendered.row_px);
    EXPECT_GE(s.share, 0.95);
    EXPECT_LE(s.rms_px, 1.5);
    EXPECT_LE(s.rms_sd, 2.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Airs, SkylineFinderTest,
                         ::testing::Values(Air{0.0, 0.0}, Air{1.0, 0.4}, Air{0.0, 0.8}));

// A level edge in the left half, and fog in the right one.
TEST(SkylineFinderInFogTest, NothingIsFoundWhereThereIsNoEdge) {
  constexpr int kWidth = 640, kHeight = 480, kEdge = 260, kFog = 330;
  cv::Mat gray(kHeight, kWidth, CV_8U, cv::Scalar(190)), noise(gray.size(), CV_16S), noisy;
  gray({0, kEdge, kFog, kHeight - kEdge}).setTo(120);
  cv::theRNG().state = 1;
  cv::randn(noise, 0.0, 2.0);
  gray.convertTo(noisy, CV_16S);
  noisy += noise;
  noisy.convertTo(gray, CV_8U);
  const Rows found = find_skyline(gray, Rows(strips_of(kWidth), Row{kEdge + 9.0, 20.0}));
  for (int strip = 0; strip < strips_of(kWidth); ++strip) {
    const auto& row = found[static_cast<std::size_t>(strip)];
    SCOPED_TRACE(strip);
    ASSERT_EQ(row.has_value(), kStrip_px * strip < kFog);
    if (row) {
      EXPECT_NEAR(row->at_px, kEdge - 0.5, 4.0 * row->sd_px);
    }
  }
}

}  // namespace
}  // namespace ols::skyline
