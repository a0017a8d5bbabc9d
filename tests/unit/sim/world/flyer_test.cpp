#include "sim/world/flyer.h"

#include <gtest/gtest.h>

namespace ols::sim {
namespace {

FlyerView view_of(double span_px, const Eigen::Vector2d& centre_px) {
  FlyerView view;
  view.centre_px = centre_px;
  // Seen from a little below, turned by half a radian.
  view.px_per_m << -std::sin(0.5), -std::cos(0.5), 0.0, 0.2 * std::cos(0.5), -0.2 * std::sin(0.5),
      -0.98;
  view.px_per_m *= span_px;
  view.span_m = 1.0;
  return view;
}

// Centroid of what differs from the plain background.
Eigen::Vector2d centroid(const cv::Mat& gray, int background) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int y = 0; y < gray.rows; ++y) {
    for (int x = 0; x < gray.cols; ++x) {
      const double darker = background - gray.at<std::uint8_t>(y, x);
      sum += darker * Eigen::Vector3d(x, y, 1.0);
    }
  }
  return sum.head<2>() / sum.z();
}

TEST(Flyer, CentroidIsTheTrueCentreAtEverySize) {
  for (double span_px : {6.0, 15.0, 40.0, 70.0}) {
    for (double shift : {0.0, 0.2, 0.5, 0.85}) {
      const Eigen::Vector2d centre(80.0 + shift, 60.0 - 0.7 * shift);
      cv::Mat gray(120, 160, CV_8U, cv::Scalar(200));
      draw_flyer(view_of(span_px, centre), gray);
      EXPECT_LT((centroid(gray, 200) - centre).norm(), 0.1) << span_px << " px, " << shift;
    }
  }
}

TEST(Flyer, CentroidStaysUnderSmear) {
  FlyerView view = view_of(30.0, {80.3, 60.6});
  view.smear_px = {5.0, -2.0};
  cv::Mat gray(120, 160, CV_8U, cv::Scalar(200));
  draw_flyer(view, gray);
  EXPECT_LT((centroid(gray, 200) - view.centre_px).norm(), 0.1);
}

TEST(Flyer, BoxEnclosesWhatIsDrawn) {
  const FlyerView view = view_of(40.0, {80.3, 60.6});
  cv::Mat gray(120, 160, CV_8U, cv::Scalar(200));
  draw_flyer(view, gray);
  cv::Mat drawn = gray != 200;
  std::vector<cv::Point> points;
  cv::findNonZero(drawn, points);
  const cv::Rect2d box = flyer_box(view);
  ASSERT_FALSE(points.empty());
  for (const cv::Point& p : points) {
    EXPECT_GT(p.x, box.x - 1.6);
    EXPECT_LT(p.x, box.x + box.width + 1.6);
    EXPECT_GT(p.y, box.y - 1.6);
    EXPECT_LT(p.y, box.y + box.height + 1.6);
  }
  EXPECT_NEAR(box.width, 40.0, 6.0);
  EXPECT_NEAR(box.x + 0.5 * box.width - 0.5, view.centre_px.x(), 1e-9) << "edges, not centres";
}

// Seen from ahead: the wings' tips go up, and the outline gets narrower.
TEST(Flyer, ABirdBeatsItsWings) {
  FlyerView view;
  view.shape = FlyerShape::kBird;
  view.centre_px = {80, 60};
  view.px_per_m << 0, -40, 0, 0, 0, -40;
  const cv::Rect2d level = flyer_box(view);
  view.wing_rad = 0.7;
  const cv::Rect2d up = flyer_box(view);
  EXPECT_NEAR(level.width, 40.0, 1.0);
  EXPECT_NEAR(up.width, 40.0 * std::cos(0.7), 2.0);
  EXPECT_LT(up.y, level.y - 8.0);
  view.wing_rad = -0.7;
  EXPECT_GT(flyer_box(view).br().y, level.br().y + 8.0);
}

TEST(Flyer, AnAircraftIsAsWideAsItsSpanAndNotAsLong) {
  FlyerView view;
  view.shape = FlyerShape::kAircraft;
  view.centre_px = {80, 60};
  view.px_per_m << 0, -40, 0, -40, 0, 0;  // from above, nose up
  const cv::Rect2d box = flyer_box(view);
  EXPECT_NEAR(box.width, 40.0, 1.0);
  EXPECT_NEAR(box.height, 32.0, 1.0);
}

TEST(Flyer, CutOffAtTheEdgeOrOutsideIsFine) {
  for (const Eigen::Vector2d& centre :
       {Eigen::Vector2d(0, 0), Eigen::Vector2d(159, 60), Eigen::Vector2d(-500, 1e6)}) {
    cv::Mat gray(120, 160, CV_8U, cv::Scalar(200));
    draw_flyer(view_of(40.0, centre), gray);
    EXPECT_LE(cv::countNonZero(gray != 200), 60 * 40);
  }
}

}  // namespace
}  // namespace ols::sim
