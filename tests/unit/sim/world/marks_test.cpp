#include "sim/world/marks.h"

#include <gtest/gtest.h>

#include "sim/scenario/scenario.h"

namespace ols::sim {
namespace {

TEST(Marks, ASignIsCentredToAFractionOfAPixel) {
  for (const Eigen::Vector2d& centre : {Eigen::Vector2d(30.0, 25.0), Eigen::Vector2d(30.3, 24.6)}) {
    cv::Mat gray(60, 60, CV_8U, cv::Scalar(100));
    draw_mark(centre, 5.0, gray);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int y = 0; y < 60; ++y) {
      for (int x = 0; x < 60; ++x) {
        sum += std::max(0, gray.at<std::uint8_t>(y, x) - 100) * Eigen::Vector3d(x, y, 1.0);
      }
    }
    EXPECT_LT((sum.head<2>() / sum.z() - centre).norm(), 0.02);
    EXPECT_EQ(gray.at<std::uint8_t>(25, 30), 245);
    EXPECT_EQ(gray.at<std::uint8_t>(25, 36), 20);  // its rim
  }
}

TEST(Marks, OneAtTheEdgeOrOutsideIsNoHarm) {
  cv::Mat gray(40, 40, CV_8U, cv::Scalar(100));
  draw_mark({0.0, 39.0}, 6.0, gray);
  EXPECT_EQ(gray.at<std::uint8_t>(39, 0), 245);
  draw_mark({-500.0, 20.0}, 6.0, gray);
  draw_mark({1e7, -1e7}, 0.1, gray);
}

TEST(Marks, TwoOfOneNameAreRefused) {
  const std::string mark = "[[mark]]\nid = \"spire\"\nposition_enu_m = [1.0, 2.0, 3.0]\n";
  EXPECT_THROW(parse_scenario("name = \"x\"\n" + mark + mark, "x.toml", "."), std::exception);
}

}  // namespace
}  // namespace ols::sim
