#include "sim/world/boards.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/config/config_section.h"
#include "edge/config/config_units.h"

namespace ols::sim {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kWhite = 210.0, kBlack = 40.0;

cv::Mat1b white_board(double width_m, double height_m) {
  const auto rows = static_cast<int>(std::lround(height_m / Board::kTexel_m));
  const auto columns = static_cast<int>(std::lround(width_m / Board::kTexel_m));
  return cv::Mat1b(rows, columns, static_cast<uchar>(kWhite));
}

// A black rectangle about a place on the board, x to the right and y up from its middle.
void blacken(cv::Mat1b& board, double x_m, double y_m, double width_m, double height_m) {
  const auto texel = [](double m) { return static_cast<int>(std::lround(m / Board::kTexel_m)); };
  const int left = board.cols / 2 + texel(x_m - 0.5 * width_m);
  const int top = board.rows / 2 - texel(y_m + 0.5 * height_m);
  const cv::Rect all({}, board.size());
  board(cv::Rect(left, top, texel(width_m), texel(height_m)) & all) = kBlack;
}

cv::Mat1b lines() {
  constexpr double kApart_m = 0.4, kThick_m = 0.04, kWidth_m = 1.8;
  cv::Mat1b board = white_board(kWidth_m, 1.7);
  for (int i = -1; i <= 1; ++i) blacken(board, 0.0, i * kApart_m, kWidth_m, kThick_m);
  return board;
}

cv::Mat1b upright_cross() {
  constexpr double kArm_m = 0.12, kThick_m = 0.03;
  cv::Mat1b board = white_board(1.0, 1.0);
  blacken(board, 0.0, 0.0, 2.0 * kArm_m, kThick_m);
  blacken(board, 0.0, 0.0, kThick_m, 2.0 * kArm_m);
  return board;
}

// White and black bars by turns, and in the middle a black one of three times the height.
cv::Mat1b ruler() {
  constexpr double kBar_m = 0.05, kWidth_m = 0.2;
  constexpr int kBars = 12;  // to each side of the zero
  cv::Mat1b board = white_board(kWidth_m, (3 + 2 * kBars) * kBar_m);
  blacken(board, 0.0, 0.0, kWidth_m, 3.0 * kBar_m);
  for (int i = 1; i < kBars; i += 2) {
    for (const int side : {-1, 1}) blacken(board, 0.0, side * (2 + i) * kBar_m, kWidth_m, kBar_m);
  }
  return board;
}

// Texels of every pixel; exact at the nodes of a grid, between them linear.
void texels(const Board& board, const CameraIntrinsics& camera, const Isometry3d& enu_cam,
            cv::Mat1f& x, cv::Mat1f& y) {
  constexpr int kStep = 16;
  const Vector3d normal = board.right.cross(board.up);
  const double height = normal.dot(board.middle - enu_cam.translation());
  const cv::Size nodes(camera.width_px / kStep + 2, camera.height_px / kStep + 2);
  cv::Mat1f node_x(nodes), node_y(nodes);
  for (int r = 0; r < nodes.height; ++r) {
    for (int c = 0; c < nodes.width; ++c) {
      const auto seen = unproject(camera, Vector2d(c * kStep, r * kStep));
      const Vector3d ray = enu_cam.linear() * seen.value_or(Vector3d(0.0, 0.0, -1.0));
      const double ahead = height / normal.dot(ray);
      const Vector3d on = enu_cam.translation() + ahead * ray - board.middle;
      const bool behind = !(ahead > 0.0);
      const double across = behind ? -1e4 : board.right.dot(on) / Board::kTexel_m;
      const double down = behind ? -1e4 : -board.up.dot(on) / Board::kTexel_m;
      node_x(r, c) = static_cast<float>(across + 0.5 * (board.gray.cols - 1));
      node_y(r, c) = static_cast<float>(down + 0.5 * (board.gray.rows - 1));
    }
  }
  // Pixel p lies at node p / kStep: no shift by half a pixel, as a resize would have it.
  cv::Mat_<double> from_pixel = (cv::Mat_<double>(2, 3) << 1.0 / kStep, 0, 0, 0, 1.0 / kStep, 0);
  const cv::Size size(camera.width_px, camera.height_px);
  const int flags = cv::INTER_LINEAR | cv::WARP_INVERSE_MAP;
  cv::warpAffine(node_x, x, from_pixel, size, flags, cv::BORDER_REPLICATE);
  cv::warpAffine(node_y, y, from_pixel, size, flags, cv::BORDER_REPLICATE);
}

// What an unsharp point becomes: an evenly lit disc.
cv::Mat1f disc(double width_px) {
  const int half = static_cast<int>(std::ceil(0.5 * width_px));
  cv::Mat1f kernel(2 * half + 1, 2 * half + 1);
  for (int y = -half; y <= half; ++y) {
    for (int x = -half; x <= half; ++x) {
      const double inside = 0.5 * width_px - std::hypot(x, y) + 0.5;
      kernel(y + half, x + half) = static_cast<float>(std::clamp(inside, 0.0, 1.0));
    }
  }
  return kernel / cv::sum(kernel)[0];
}

// X ahead, Y along the tilt axis to the left, of the unit without its camera.
Isometry3d head_at(const ChainParameters& chain, double trunnion_rad, const PanTilt& shafts) {
  ChainParameters bare = chain;
  bare.mount_z_rad = bare.mount_x_rad = bare.mount_y_rad = 0.0;
  bare.ele_to_focus_m.setZero();
  bare.focus_to_camera_m.setZero();
  const Isometry3d camera = camera_on(bare, trunnion_rad, shafts);
  Isometry3d head = camera;
  head.linear() << camera.linear().col(2), -camera.linear().col(0), -camera.linear().col(1);
  return head;
}

// Where the middle of the picture looks, so far from the pan axis.
struct Sight {
  Vector3d place = Vector3d::Zero(), right = Vector3d::UnitX();
};

Sight ahead_of(const ChainParameters& chain, double trunnion_rad, const CameraIntrinsics& camera,
               const PanTilt& shafts, double away_m) {
  const Isometry3d pose = camera_on(chain, trunnion_rad, shafts);
  const Vector3d axis = head_at(chain, trunnion_rad, shafts).translation();
  const Vector2d middle(0.5 * (camera.width_px - 1), 0.5 * (camera.height_px - 1));
  const Vector3d ray = pose.linear() * unproject(camera, middle).value_or(Vector3d(0.0, 0.0, 1.0));
  const Vector2d level = ray.head<2>().normalized();
  const double from_axis_m = (pose.translation() - axis).head<2>().dot(level);
  const double along = (away_m - from_axis_m) / ray.head<2>().norm();
  return {pose.translation() + along * ray, Vector3d(level.y(), -level.x(), 0.0)};
}

}  // namespace

config::Section boards_section(BoardsScenario& b) {
  constexpr config::Range kAway_m{5.0, 1000.0};
  return {"boards",
          "Rectification targets, as a person puts them up while the site runs.",
          {config::number("level_line_m", b.level_line_m, kAway_m, "m", "Distance of the lines."),
           config::number("level_error_deg", b.level_error_rad, {-5.0, 5.0}, station::in_degrees(),
                          "How far they are from level, right side down positive."),
           config::number("cross_m", b.cross_m, kAway_m, "m", "Distance of the cross."),
           config::number("cross_error_m", b.cross_error_m, {-1.0, 1.0}, "m",
                          "How far it is to the right of where the unit points."),
           config::number("near_ruler_m", b.near_ruler_m, kAway_m, "m", "Distance of a ruler."),
           config::number("far_ruler_m", b.far_ruler_m, kAway_m, "m", "Of the other one."),
           config::number("ruler_error_m", b.ruler_error_m, {-1.0, 1.0}, "m",
                          "How far the farther zero is above the nearer one."),
           config::number("blur_px_m", b.blur_px_m, {0.0, 1e4}, "px m",
                          "Width of a point's blur times its distance.")}};
}

void draw_board(const Board& board, const CameraIntrinsics& camera, const Isometry3d& enu_cam,
                cv::Mat& gray) {
  // Not behind the camera, nor edge on.
  const Vector3d seen = enu_cam.inverse() * board.middle;
  if (seen.z() <= 0.0) return;
  cv::Mat1f x, y;
  texels(board, camera, enu_cam, x, y);
  // A pixel is larger than a texel: without averages the bars would beat with the pixels.
  const double texels_of_pixel = seen.z() / camera.fx_px / Board::kTexel_m;
  cv::Mat1b smooth;
  cv::GaussianBlur(board.gray, smooth, {}, 0.4 * texels_of_pixel);
  cv::Mat1f light, covered, source, whole(board.gray.size(), 1.0F);
  smooth.convertTo(source, CV_32F);
  cv::remap(source, light, x, y, cv::INTER_LINEAR, cv::BORDER_CONSTANT, 0);
  cv::remap(whole, covered, x, y, cv::INTER_LINEAR, cv::BORDER_CONSTANT, 0);
  const cv::Rect all({}, gray.size());
  cv::Rect part = cv::boundingRect(covered > 0.0F);
  if (part.empty()) return;
  const int reach = static_cast<int>(std::ceil(board.blur_px));
  part = cv::Rect(part.x - reach, part.y - reach, part.width + 2 * reach, part.height + 2 * reach) &
         all;
  cv::Mat1f board_light = light(part).clone(), board_covered = covered(part).clone();
  if (board.blur_px > 1.0) {
    const cv::Mat1f kernel = disc(board.blur_px);
    const int border = cv::BORDER_REPLICATE | cv::BORDER_ISOLATED;
    cv::filter2D(board_light, board_light, -1, kernel, {-1, -1}, 0.0, border);
    cv::filter2D(board_covered, board_covered, -1, kernel, {-1, -1}, 0.0, border);
  }
  cv::Mat1f behind;
  gray(part).convertTo(behind, CV_32F);
  const cv::Mat1f together = behind.mul(1.0F - board_covered) + board_light;
  together.convertTo(gray(part), CV_8U);
}

// Square to the line of sight, upright.
std::vector<Board> Boards::level_line(const CameraIntrinsics& camera, const PanTilt& shafts) const {
  const Sight sight = ahead_of(chain_, trunnion_rad_, camera, shafts, scenario_.level_line_m);
  const Vector3d ahead = Vector3d::UnitZ().cross(sight.right);
  const Eigen::AngleAxisd leans(scenario_.level_error_rad, ahead);
  Board board{sight.place, leans * sight.right, leans * Vector3d::UnitZ(), lines()};
  board.blur_px = scenario_.blur_px_m / scenario_.level_line_m;
  return {board};
}

// In the plane that is square to the tilt axis, at the height where the camera sees it.
std::vector<Board> Boards::cross(const CameraIntrinsics& camera, const PanTilt& shafts) const {
  const Isometry3d head = head_at(chain_, trunnion_rad_, shafts);
  const Sight sight = ahead_of(chain_, trunnion_rad_, camera, shafts, scenario_.cross_m);
  const double height_m = (head.inverse() * sight.place).z();
  const double ahead_m = std::sqrt(std::pow(scenario_.cross_m, 2) - std::pow(height_m, 2));
  Board board;
  board.middle = head * Vector3d(ahead_m, -scenario_.cross_error_m, height_m);
  board.right = sight.right;
  board.gray = upright_cross();
  board.blur_px = scenario_.blur_px_m / scenario_.cross_m;
  return {board};
}

// Both zeros at one height, the farther ruler beside the nearer one in the picture.
std::vector<Board> Boards::rulers(const CameraIntrinsics& camera, const PanTilt& shafts) const {
  constexpr double kNearRight_m = -0.3, kFarRight_m = 0.6;
  const Sight near = ahead_of(chain_, trunnion_rad_, camera, shafts, scenario_.near_ruler_m);
  const Sight far = ahead_of(chain_, trunnion_rad_, camera, shafts, scenario_.far_ruler_m);
  Board first{near.place + kNearRight_m * near.right, near.right, Vector3d::UnitZ(), ruler()};
  Board second{far.place + kFarRight_m * far.right, far.right, Vector3d::UnitZ(), ruler()};
  second.middle.z() = first.middle.z() + scenario_.ruler_error_m;
  first.blur_px = scenario_.blur_px_m / scenario_.near_ruler_m;
  second.blur_px = scenario_.blur_px_m / scenario_.far_ruler_m;
  return {second, first};  // the nearer one hides the farther one
}

void Boards::put_up(const ByHand& by_hand, const CameraIntrinsics& camera, const PanTilt& shafts) {
  if (!by_hand.level_line) level_line_.clear();
  if (!by_hand.cross) cross_.clear();
  if (!by_hand.rulers) rulers_.clear();
  if (by_hand.level_line && level_line_.empty()) level_line_ = level_line(camera, shafts);
  if (by_hand.cross && cross_.empty()) cross_ = cross(camera, shafts);
  if (by_hand.rulers && rulers_.empty()) rulers_ = rulers(camera, shafts);
}

void Boards::draw(const CameraIntrinsics& camera, const Isometry3d& enu_cam, cv::Mat& gray) const {
  for (const auto* boards : {&level_line_, &cross_, &rulers_}) {
    for (const Board& board : *boards) draw_board(board, camera, enu_cam, gray);
  }
}

}  // namespace ols::sim
