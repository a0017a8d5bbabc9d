// Landmarks in the simulated landscape: round white signs with a dark rim, visible against sky and
// wood. Their edges are drawn analytically: the centre is exact to a small fraction of a pixel.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace ols::config {
struct Section;
}
namespace ols::sim {

struct Mark {
  std::string id;
  Eigen::Vector3d p_enu = Eigen::Vector3d::Zero();  // [m] in the site's frame
  double size_m = 1.0;                              // diameter of the white disc
};

config::Section mark_section(std::vector<Mark>& marks);

// Draws a disc of this radius and its rim, which is half as wide as the radius.
void draw_mark(const Eigen::Vector2d& centre_px, double radius_px, cv::Mat& gray);

}  // namespace ols::sim
