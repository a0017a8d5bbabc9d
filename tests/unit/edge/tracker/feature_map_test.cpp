#include "edge/tracker/feature_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace ols::tracker {
namespace {

// Grey to the left, a colour (blue, green, red) to the right.
TrackerInput half(const cv::Scalar& bgr) {
  TrackerInput frame;
  frame.gray = cv::Mat(200, 200, CV_8U, cv::Scalar(100));
  frame.colour.image = cv::Mat(200, 200, CV_8UC3, cv::Scalar(100, 100, 100));
  cv::rectangle(frame.colour.image, cv::Rect(100, 0, 100, 200), bgr, cv::FILLED);
  return frame;
}

TrackerInput half_red() { return half({100, 20, 180}); }

FeatureMap features_of(const TrackerInput& frame) {
  return extract_features(view_window(frame, {{99.5, 99.5}, 3.0}));
}

float greatest(const Map& map) { return *std::max_element(map.begin(), map.end()); }

TEST(FeatureMap, AColourShowsWhereGreyLevelsAreEqual) {
  const TrackerInput frame = half_red();
  const FeatureMap features = features_of(frame);
  EXPECT_GT(greatest(features[kChannels - 2]), 0.3F);
  for (std::size_t c = 0; c + 2 < features.size(); ++c)
    EXPECT_LT(greatest(features[c]), 1e-6F) << c;
}

TEST(FeatureMap, BrightnessIsNoColour) {
  const FeatureMap features = features_of(half({200, 200, 200}));
  for (std::size_t c = kChannels - 2; c < kChannels; ++c) {
    EXPECT_LT(greatest(features[c]), 1e-6F) << c;
  }
}

TEST(FeatureMap, YellowAndBlueAreOpposites) {
  const auto yellow_at = [](const cv::Scalar& bgr, std::size_t column) {
    const FeatureMap features = features_of(half(bgr));
    EXPECT_LT(greatest(features[kChannels - 2]), 1e-6F);
    return features[kChannels - 1][kMapSide * (kMapSide / 2) + column];
  };
  EXPECT_GT(yellow_at({40, 120, 120}, kMapSide * 3 / 4), 0.1F);
  EXPECT_LT(yellow_at({160, 80, 80}, kMapSide * 3 / 4), -0.1F);
}

TEST(FeatureMap, WithoutAColourImageItsChannelsAreZero) {
  TrackerInput frame = half_red();
  frame.colour = {};
  const FeatureMap features = features_of(frame);
  EXPECT_EQ(greatest(features[kChannels - 2]), 0.0F);
  EXPECT_EQ(greatest(features[kChannels - 1]), 0.0F);
}

TEST(FeatureMap, AnEdgesDirectionHasItsChannel) {
  TrackerInput frame;
  frame.gray = cv::Mat(200, 200, CV_8U, cv::Scalar(50));
  cv::rectangle(frame.gray, cv::Rect(100, 0, 100, 200), cv::Scalar(150), cv::FILLED);
  const FeatureMap features = features_of(frame);
  EXPECT_GT(greatest(features[0]), 0.3F);   // brighter to the right
  EXPECT_LT(greatest(features[6]), 1e-6F);  // to the left
  EXPECT_GT(greatest(features[12]), 0.3F);  // either
}

}  // namespace
}  // namespace ols::tracker
