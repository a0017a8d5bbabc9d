#include "tools/calibrate/board_detection.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <opencv2/aruco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/unit/error_text.h"

namespace ols::calibration {
namespace {

constexpr int kSquare_px = 60, kMargin_px = 60;  // of the drawn board

cv::Mat marker(int dictionary, int id, int edge_px) {
  cv::Mat drawn;
  cv::aruco::drawMarker(cv::aruco::getPredefinedDictionary(dictionary), id, edge_px, drawn, 1);
  return drawn;
}

cv::Mat sheet(const BoardShape& shape) {
  return {shape.rows * kSquare_px + 2 * kMargin_px, shape.columns * kSquare_px + 2 * kMargin_px,
          CV_8U, cv::Scalar(255)};
}
cv::Rect cell(int row, int column, int edge_px, int shift_px) {
  return {kMargin_px + column * kSquare_px + shift_px, kMargin_px + row * kSquare_px + shift_px,
          edge_px, edge_px};
}

// As printers draw it: the upper left square is black, the markers are numbered in the white ones.
cv::Mat charuco(const BoardShape& shape) {
  cv::Mat board = sheet(shape);
  const int edge_px = static_cast<int>(std::lround(kSquare_px * shape.marker_m / shape.square_m));
  int id = 0;
  for (int row = 0; row < shape.rows; ++row) {
    for (int column = 0; column < shape.columns; ++column) {
      if ((row + column) % 2 == 0) {
        board(cell(row, column, kSquare_px, 0)).setTo(0);
      } else {
        marker(cv::aruco::DICT_5X5_1000, id++, edge_px)
            .copyTo(board(cell(row, column, edge_px, (kSquare_px - edge_px) / 2)));
      }
    }
  }
  return board;
}

// `turned`: every tag by so many quarter turns; `upwards`: the first one is in the lowest row.
cv::Mat tags(const BoardShape& shape, int turned, bool upwards) {
  cv::Mat board = sheet(shape);
  const int edge_px = static_cast<int>(std::lround(kSquare_px * shape.marker_m / shape.square_m));
  for (int id = 0; id < shape.columns * shape.rows; ++id) {
    cv::Mat tag = marker(cv::aruco::DICT_APRILTAG_36h11, id, edge_px);
    for (int k = 0; k < turned; ++k) cv::rotate(tag, tag, cv::ROTATE_90_CLOCKWISE);
    const int row = id / shape.columns;
    tag.copyTo(board(cell(upwards ? shape.rows - 1 - row : row, id % shape.columns, edge_px, 0)));
  }
  return board;
}

// Seen from the side, a little soft, with noise.
struct View {
  cv::Mat picture;
  cv::Mat H;  // pixels of the picture by those of the drawn board
};
View seen(const cv::Mat& board) {
  const auto w = static_cast<float>(board.cols), h = static_cast<float>(board.rows);
  const std::vector<cv::Point2f> from{{0, 0}, {w, 0}, {w, h}, {0, h}};
  const std::vector<cv::Point2f> to{{70, 40}, {590, 70}, {560, 440}, {50, 400}};
  View view;
  view.H = cv::getPerspectiveTransform(from, to);
  cv::warpPerspective(board, view.picture, view.H, {640, 480}, cv::INTER_AREA, cv::BORDER_CONSTANT,
                      cv::Scalar(200));
  cv::GaussianBlur(view.picture, view.picture, {}, 0.8);
  cv::Mat noise(view.picture.size(), CV_16S), noisy;
  cv::RNG(5).fill(noise, cv::RNG::NORMAL, 0.0, 2.0);
  view.picture.convertTo(noisy, CV_16S);
  cv::Mat(noisy + noise).convertTo(view.picture, CV_8U);
  return view;
}

// RMS distance of the corners from where the drawn board has them [px]; the board's own frame may
// be turned or have its Y upwards, which is a homography, too.
double plane_rms(const BoardView& view) {
  std::vector<cv::Point2f> flat, there;
  for (const cv::Point3f& p : view.board) flat.emplace_back(p.x, p.y);
  cv::perspectiveTransform(flat, there, cv::findHomography(flat, view.pixels));
  return cv::norm(there, view.pixels, cv::NORM_L2) / std::sqrt(static_cast<double>(flat.size()));
}
// The largest distance of a corner from the nearest one that was drawn.
double farthest(const BoardView& found, const View& view, const std::vector<cv::Point2f>& drawn) {
  std::vector<cv::Point2f> there;
  cv::perspectiveTransform(drawn, there, view.H);
  double most = 0.0;
  for (const cv::Point2f& pixel : found.pixels) {
    double nearest = 1e9;
    for (const cv::Point2f& p : there) nearest = std::min(nearest, cv::norm(pixel - p));
    most = std::max(most, nearest);
  }
  return most;
}
std::string refusal(const BoardShape& shape) {
  return error_text<std::invalid_argument>([&] { check_board(shape); });
}

TEST(BoardDetection, ACharucoOfOddRowsIsFoundCornerByCorner) {
  const BoardShape shape{"charuco", 7, 5, 0.03, 0.022};
  check_board(shape);
  const View view = seen(charuco(shape));
  const BoardView found = find_board(view.picture, shape);
  ASSERT_EQ(found.pixels.size(), 24U);
  EXPECT_LT(plane_rms(found), 0.15);
  std::vector<cv::Point2f> drawn;
  for (int row = 1; row < shape.rows; ++row) {
    for (int column = 1; column < shape.columns; ++column) {
      drawn.emplace_back(static_cast<float>(kMargin_px + column * kSquare_px) - 0.5F,
                         static_cast<float>(kMargin_px + row * kSquare_px) - 0.5F);
    }
  }
  EXPECT_LT(farthest(found, view, drawn), 1.0);
  // Neighbours on the board are a square apart.
  EXPECT_NEAR(cv::norm(found.board[1] - found.board[0]), 0.03, 1e-6);
}

TEST(BoardDetection, ACharucoOfEvenRowsIsRefused) {
  EXPECT_NE(refusal({"charuco", 7, 6, 0.03, 0.022}).find("OpenCV 4.6 misplaces"),
            std::string::npos);
  EXPECT_EQ(refusal({"charuco", 6, 5, 0.03, 0.022}), "");
}

TEST(BoardDetection, AprilTagsAreFoundHoweverTheyAreNumberedAndTurned) {
  const BoardShape shape{"apriltag", 6, 4, 0.04, 0.03};
  check_board(shape);
  for (const bool upwards : {false, true}) {
    for (int turned = 0; turned < 4; ++turned) {
      const View view = seen(tags(shape, turned, upwards));
      const BoardView found = find_board(view.picture, shape);
      ASSERT_GE(found.pixels.size(), 84U) << turned << upwards;  // of 96: some tags are small
      EXPECT_LT(plane_rms(found), 0.25) << turned << upwards;
    }
  }
}

TEST(BoardDetection, TagsOfAnotherBoardOrTooFewAreNoBoard) {
  const BoardShape shape{"apriltag", 6, 4, 0.04, 0.03};
  View view = seen(tags(shape, 0, false));
  // Six in a row, where the board has four: nothing of it lies in a plane.
  EXPECT_TRUE(find_board(view.picture, {"apriltag", 4, 6, 0.04, 0.03}).pixels.empty());
  cv::rectangle(view.picture, {0, 0, 640, 360}, 128, cv::FILLED);
  cv::rectangle(view.picture, {0, 0, 400, 480}, 128, cv::FILLED);
  EXPECT_TRUE(find_board(view.picture, shape).pixels.empty());
  EXPECT_NE(refusal({"apriltag", 6, 4, 0.04, 0.05}).find("--marker"), std::string::npos);
  EXPECT_NE(refusal({"apriltag", 30, 30, 0.04, 0.03}).find("587"), std::string::npos);
  EXPECT_NE(refusal({"chessboard", 2, 6, 0.025, 0.0}).find("3 .. 100"), std::string::npos);
}

// The pictures that OpenCV comes with, from a folder that not everybody has.
TEST(BoardDetection, TheChessboardsOfTheEvaluationDataAreFound) {
  const char* shared = std::getenv("OLS_SHARED");
  const std::string folder =
      shared ? std::string(shared) + "/data/calibration/opencv_chessboard" : "";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "OLS_SHARED is not set";
  int found = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (!entry.path().filename().string().starts_with("left") ||
        entry.path().extension() != ".jpg") {
      continue;
    }
    const cv::Mat picture = cv::imread(entry.path(), cv::IMREAD_GRAYSCALE);
    const BoardView view = find_board(picture, {"chessboard", 9, 6, 0.025, 0.0});
    found += view.pixels.size() == 54U && plane_rms(view) < 3.0 ? 1 : 0;
  }
  EXPECT_GE(found, 11);
}

}  // namespace
}  // namespace ols::calibration
