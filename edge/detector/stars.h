// Whether a picture may show stars, and how they move in it.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace ols::detector {

struct Stars {
  bool show = false;  // the picture was taken at night
  // Maps a star's pixel in the previous picture to its pixel in this one. It is computed from the
  // mount's angles and the Earth's rotation; nullopt if unknown.
  std::optional<Eigen::Matrix3d> motion = {};
};

}  // namespace ols::detector
