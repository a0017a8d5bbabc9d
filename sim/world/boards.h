// The paper's rectification targets in the simulated camera's picture: level lines, a cross, two
// rulers. A person puts up each target where the camera points at that moment, with the small
// errors of spirit level, pointer and tape. From then on the target stays in place. Written from
// docs/calibration.md, without the product's code that reads the targets.
#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <vector>

#include "geometry/lens.h"
#include "sim/scenario/faults.h"
#include "sim/world/unit_truth.h"

namespace ols::config {
struct Section;
}
namespace ols::sim {

// Distances from the pan axis at which a person puts the targets, and the person's errors.
struct BoardsScenario {
  double level_line_m = 30.0;
  double level_error_rad = 0.0;  // roll of the lines, positive if the right side is low
  double cross_m = 25.0;
  // How far the cross is to the right of the vertical plane in which the unit tilts.
  double cross_error_m = 0.0;
  double near_ruler_m = 20.0, far_ruler_m = 40.0;
  double ruler_error_m = 0.0;  // height of the farther ruler's zero above the nearer ruler's
  // The lens is focused at infinity. The blur of a point [px] is this divided by the point's
  // distance [m].
  double blur_px_m = 0.0;
};

config::Section boards_section(BoardsScenario& boards);

// A flat, upright rectangle.
struct Board {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  // [m] in GROUND: east, north, up
  Eigen::Vector3d right = Eigen::Vector3d::UnitX(), up = Eigen::Vector3d::UnitZ();
  cv::Mat1b gray;  // its print, top row first; a texel is kTexel_m wide
  double blur_px = 0.0;
  static constexpr double kTexel_m = 0.001;
};

// `enu_cam`: the camera's pose in GROUND, OpenCV's axes.
void draw_board(const Board& board, const CameraIntrinsics& camera,
                const Eigen::Isometry3d& enu_cam, cv::Mat& gray);

// The targets in front of one station.
class Boards {
 public:
  Boards(const BoardsScenario& scenario, const ChainParameters& chain, double trunnion_rad)
      : scenario_(scenario), chain_(chain), trunnion_rad_(trunnion_rad) {}

  // Puts up the targets that are new in `by_hand`, where the camera points with the shafts at these
  // angles. Removes targets that are no longer in `by_hand`.
  void put_up(const ByHand& by_hand, const CameraIntrinsics& camera, const PanTilt& shafts);

  void draw(const CameraIntrinsics& camera, const Eigen::Isometry3d& enu_cam, cv::Mat& gray) const;

 private:
  std::vector<Board> level_line(const CameraIntrinsics& camera, const PanTilt& shafts) const;
  std::vector<Board> cross(const CameraIntrinsics& camera, const PanTilt& shafts) const;
  std::vector<Board> rulers(const CameraIntrinsics& camera, const PanTilt& shafts) const;

  BoardsScenario scenario_;
  ChainParameters chain_;
  double trunnion_rad_;
  std::vector<Board> level_line_, cross_, rulers_;
};

}  // namespace ols::sim
