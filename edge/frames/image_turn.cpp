#include "edge/frames/image_turn.h"

#include <Eigen/Dense>
#include <cmath>

#include "geometry/angles.h"

namespace ols::station {

std::optional<ImageTurn> image_turn(const ChainParameters& chain, const CameraIntrinsics& camera,
                                    const PanTilt& angles, const tracker::ImageMotion& motion) {
  const auto middle = unproject(camera, motion.middle_px);
  if (!middle) return std::nullopt;
  const Eigen::Vector3d there_enu = enu_from_camera(chain, angles).linear() * *middle;
  // The turn that brings the middle of the corners to a pixel.
  const auto turn_to = [&](const Eigen::Vector2d& pixel) -> std::optional<Eigen::Vector2d> {
    const auto ray = unproject(camera, pixel);
    const auto to = ray ? aim(chain, there_enu, *ray) : std::nullopt;
    if (!to) return std::nullopt;
    return Eigen::Vector2d(wrap_pi(to->pan_rad - angles.pan_rad), to->tilt_rad - angles.tilt_rad);
  };
  const Eigen::Vector2d pixel = (motion.homography * motion.middle_px.homogeneous()).hnormalized();
  const auto none = turn_to(motion.middle_px), turn = turn_to(pixel);
  const auto right = turn_to(pixel + Eigen::Vector2d::UnitX());
  const auto below = turn_to(pixel + Eigen::Vector2d::UnitY());
  // Beyond the vertical, aim() returns other angles of the same direction.
  constexpr double kSame_rad = 1e-6;
  if (!none || !turn || !right || !below || none->norm() > kSame_rad) return std::nullopt;
  const Eigen::Vector2d sd =
      motion.sd_px * ((*right - *turn).array().square() + (*below - *turn).array().square()).sqrt();
  return ImageTurn{{turn->x(), turn->y()}, {sd.x(), sd.y()}};
}

}  // namespace ols::station
