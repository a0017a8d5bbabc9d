// What is known of the stars in a picture.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace ols::detector {

struct Stars {
  bool show = false;  // it is night
  // Maps a star's pixel in the previous picture to its pixel in this one, by the mount's angles and
  // the Earth's rotation; nullopt if unknown.
  std::optional<Eigen::Matrix3d> motion = {};
};

}  // namespace ols::detector
