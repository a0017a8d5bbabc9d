#include "tools/calibrate/board_detection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace ols::calibration {
namespace {

// The search for a corner must not reach its neighbours: a third of the way to the nearest one.
int search_window(const std::vector<cv::Point2f>& corners) {
  double nearest = 1e9;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    nearest = std::min(nearest, cv::norm(corners[i] - corners[i - 1]));
  }
  constexpr int kLeast = 2, kMost = 5;
  return std::clamp(static_cast<int>(nearest / 3.0), kLeast, kMost);
}

void refine(const cv::Mat& picture, int half, std::vector<cv::Point2f>& pixels) {
  const cv::TermCriteria until(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 50, 1e-4);
  cv::cornerSubPix(picture, pixels, {half, half}, {-1, -1}, until);
}

BoardView chessboard_in(const cv::Mat& picture, const BoardShape& shape) {
  BoardView view;
  if (!cv::findChessboardCorners(picture, {shape.columns, shape.rows}, view.pixels)) return {};
  refine(picture, search_window(view.pixels), view.pixels);
  for (int row = 0; row < shape.rows; ++row) {
    for (int column = 0; column < shape.columns; ++column) {
      view.board.emplace_back(static_cast<float>(column * shape.square_m),
                              static_cast<float>(row * shape.square_m), 0.0F);
    }
  }
  return view;
}

BoardView charuco_in(const cv::Mat& picture, const BoardShape& shape) {
  const auto dictionary = cv::aruco::getPredefinedDictionary(cv::aruco::DICT_5X5_1000);
  const auto board =
      cv::aruco::CharucoBoard::create(shape.columns, shape.rows, static_cast<float>(shape.square_m),
                                      static_cast<float>(shape.marker_m), dictionary);
  std::vector<std::vector<cv::Point2f>> markers;
  std::vector<int> marker_ids, ids;
  cv::aruco::detectMarkers(picture, dictionary, markers, marker_ids);
  BoardView view;
  if (marker_ids.empty()) return view;
  cv::aruco::interpolateCornersCharuco(markers, marker_ids, picture, board, view.pixels, ids);
  constexpr std::size_t kLeastCorners = 8;
  if (ids.size() < kLeastCorners) return {};
  for (const int id : ids)
    view.board.push_back(board->chessboardCorners.at(static_cast<std::size_t>(id)));
  return view;
}

struct Tag {
  int column = 0, row = 0;
  std::vector<cv::Point2f> corners;  // clockwise
};

std::vector<cv::Point3f> tag_corners(const Tag& tag, const BoardShape& shape, bool upwards,
                                     std::size_t turn) {
  const int row = upwards ? shape.rows - 1 - tag.row : tag.row;
  const auto x = static_cast<float>(tag.column * shape.square_m);
  const auto y = static_cast<float>(row * shape.square_m);
  const auto edge = static_cast<float>(shape.marker_m);
  std::vector<cv::Point3f> corners{
      {x, y, 0.0F}, {x + edge, y, 0.0F}, {x + edge, y + edge, 0.0F}, {x, y + edge, 0.0F}};
  std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(turn), corners.end());
  return corners;
}

double plane_misfit(const BoardView& view) {
  std::vector<cv::Point2f> flat, there;
  for (const cv::Point3f& p : view.board) flat.emplace_back(p.x, p.y);
  const cv::Mat H = cv::findHomography(flat, view.pixels);
  if (H.empty()) return std::numeric_limits<double>::infinity();
  cv::perspectiveTransform(flat, there, H);
  return cv::norm(there, view.pixels, cv::NORM_L2) / std::sqrt(static_cast<double>(flat.size()));
}

// Printers of tags number them from the top or from the bottom, and begin at different corners. The
// right arrangement is the one that lies in a plane.
BoardView best_arrangement(const std::vector<Tag>& tags, const BoardShape& shape) {
  constexpr double kFlat = 0.1;  // of a tag's edge: the lens bends a plane by less
  BoardView best;
  double least = std::numeric_limits<double>::infinity();
  for (const bool upwards : {false, true}) {
    for (std::size_t turn = 0; turn < 4; ++turn) {
      BoardView view;
      for (const Tag& tag : tags) {
        const auto corners = tag_corners(tag, shape, upwards, turn);
        view.board.insert(view.board.end(), corners.begin(), corners.end());
        view.pixels.insert(view.pixels.end(), tag.corners.begin(), tag.corners.end());
      }
      const double misfit = plane_misfit(view);
      if (misfit < least) least = misfit, best = std::move(view);
    }
  }
  const double edge_px = cv::norm(tags[0].corners[1] - tags[0].corners[0]);
  return least < kFlat * edge_px ? best : BoardView{};
}

BoardView tags_in(const cv::Mat& picture, const BoardShape& shape) {
  const auto dictionary = cv::aruco::getPredefinedDictionary(cv::aruco::DICT_APRILTAG_36h11);
  std::vector<std::vector<cv::Point2f>> found;
  std::vector<int> ids;
  cv::aruco::detectMarkers(picture, dictionary, found, ids);
  std::vector<Tag> tags;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (ids[i] >= shape.columns * shape.rows) continue;  // of another board
    refine(picture, search_window(found[i]), found[i]);
    tags.push_back({ids[i] % shape.columns, ids[i] / shape.columns, found[i]});
  }
  constexpr std::size_t kLeastTags = 4;
  if (tags.size() < kLeastTags) return {};
  return best_arrangement(tags, shape);
}

}  // namespace

void check_board(const BoardShape& shape) {
  constexpr int kMost = 100;
  const bool tags = shape.kind == "apriltag";
  const int least = tags ? 2 : 3;
  if (std::min(shape.columns, shape.rows) < least || std::max(shape.columns, shape.rows) > kMost) {
    throw std::invalid_argument("--columns, --rows: are outside " + std::to_string(least) +
                                " .. 100");
  }
  if (shape.kind == "chessboard") return;
  constexpr int kTags = 587;  // of the family 36h11
  if (tags && shape.columns * shape.rows > kTags) {
    throw std::invalid_argument("--columns, --rows: the family 36h11 has 587 tags");
  }
  // OpenCV 4.6 begins boards of an even number of rows with the other colour.
  if (!tags && shape.rows % 2 == 0) {
    throw std::invalid_argument(
        "--rows: an odd number is needed of a ChArUco: OpenCV 4.6 misplaces "
        "the corners of even ones");
  }
  if (!(shape.marker_m > 0.0 && shape.marker_m < shape.square_m)) {
    throw std::invalid_argument(std::string("--marker: is needed of ") +
                                (tags ? "AprilTags" : "a ChArUco") +
                                ", and is smaller than --square");
  }
}

BoardView find_board(const cv::Mat& picture, const BoardShape& shape) {
  if (shape.kind == "charuco") return charuco_in(picture, shape);
  if (shape.kind == "apriltag") return tags_in(picture, shape);
  return chessboard_in(picture, shape);
}

}  // namespace ols::calibration
