#include "calibration/procedure/pointing_dialog.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace ols::calibration {
namespace {

using Event = PointingDialog::Event;

Taken picture() {
  Taken taken;
  taken.gray = cv::Mat(240, 320, CV_8U, cv::Scalar(150));
  cv::circle(taken.gray, {200, 120}, 4, cv::Scalar(20), cv::FILLED, cv::LINE_AA);
  return taken;
}

class PointingDialogTest : public testing::Test {
 protected:
  PointingDialogTest() { dialog.begin("mast", picture()); }
  bool offers(const std::string& choice) const {
    return std::ranges::count(dialog.question()->question.choices, choice) == 1;
  }
  PointingDialog dialog;
};

TEST_F(PointingDialogTest, ACrosshairSnapsToWhatIsPointedAtAndIsConfirmed) {
  EXPECT_FALSE(offers("confirm"));
  EXPECT_EQ(dialog.answered({"confirm", {}, {}}), Event::kAsksOn) << "there is no crosshair";
  EXPECT_EQ(dialog.answered({"point", Eigen::Vector2d(203.0, 118.0), {}}), Event::kAsksOn);
  ASSERT_TRUE(dialog.has_crosshair());
  EXPECT_NEAR(dialog.pixel().x(), 200.0, 0.1);
  EXPECT_NEAR(dialog.pixel().y(), 120.0, 0.1);
  EXPECT_TRUE(offers("confirm"));
  EXPECT_EQ(dialog.answered({"confirm", {}, {}}), Event::kConfirmed);
}

TEST_F(PointingDialogTest, AMarkLargerThanTheWindowIsFoundFromItsEvenMiddle) {
  Taken large = picture();
  cv::circle(large.gray, {100, 120}, 16, cv::Scalar(20), cv::FILLED, cv::LINE_AA);
  cv::circle(large.gray, {100, 120}, 13, cv::Scalar(220), cv::FILLED, cv::LINE_AA);
  cv::Mat noise(large.gray.size(), CV_8U);
  cv::RNG(1).fill(noise, cv::RNG::NORMAL, 10.0, 2.0);  // without any, a trace of an edge stands out
  large.gray += noise;
  dialog.begin("spire", large);
  dialog.answered({"point", Eigen::Vector2d(101.0, 121.0), {}});
  ASSERT_TRUE(dialog.has_crosshair()) << dialog.question()->question.text;
  EXPECT_NEAR(dialog.pixel().x(), 100.0, 0.1);
  EXPECT_NEAR(dialog.pixel().y(), 120.0, 0.1);
}

TEST_F(PointingDialogTest, WhereNothingStandsOutItSaysSoAndTakesTheExactPixel) {
  dialog.answered({"point", Eigen::Vector2d(60.0, 60.0), {}});
  EXPECT_FALSE(dialog.has_crosshair());
  EXPECT_NE(dialog.question()->question.text.find("No crosshair"), std::string::npos);
  dialog.answered({"exactly", Eigen::Vector2d(60.0, 60.0), {}});
  ASSERT_TRUE(dialog.has_crosshair());
  EXPECT_EQ(dialog.pixel(), Eigen::Vector2d(60.0, 60.0));
  EXPECT_EQ(dialog.sd_px(), 0.5);
}

TEST_F(PointingDialogTest, TurningAndSkippingAreLeftToWhoeverAsks) {
  EXPECT_EQ(dialog.answered({"turn", {}, {0.1, 0.0}}), Event::kTurn);
  EXPECT_EQ(dialog.answered({"skip", {}, {}}), Event::kSkipped);
  EXPECT_EQ(dialog.answered({"point", Eigen::Vector2d(-3.0, 0.0), {}}), Event::kAsksOn);
  EXPECT_NE(dialog.question()->question.text.find("A pixel of the picture"), std::string::npos);
  dialog.end();
  EXPECT_FALSE(dialog.question());
  EXPECT_EQ(dialog.answered({"skip", {}, {}}), Event::kAsksOn);
}

}  // namespace
}  // namespace ols::calibration
