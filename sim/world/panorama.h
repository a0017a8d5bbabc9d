// The background of the target: wooded slopes below a ridge line, with sky and clouds above.
// Everything is at infinity, so that it moves by a pure rotation's homography.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <opencv2/core.hpp>
#include <vector>

#include "geometry/lens.h"
#include "sim/scenario/scenario.h"

namespace ols::sim {

// The wood on the slopes, for cameras of this size. Takes about a second.
cv::Mat slopes_texture(const Landscape& landscape, const CameraIntrinsics& camera);

class Panorama {
 public:
  // One panorama per station, with about one texel per pixel of this camera. `slopes`: from
  // slopes_texture(), shared by the stations.
  Panorama(const Landscape& landscape, const CameraIntrinsics& camera, const cv::Mat& slopes,
           std::uint64_t seed);

  // Changes the focal length from now on. With a longer focal length than at construction, the
  // panorama looks coarser.
  void set_camera(const CameraIntrinsics& camera);
  // Draws the background of an image taken with this rotation (camera to east-north-up).
  void draw(const Eigen::Matrix3d& R_enu_cam, cv::Mat& gray);

  // Near land stands before the ridge line where it is higher: elevations [rad] by azimuth.
  void raise(const std::function<double(double azimuth_rad)>& skyline_rad);

  // Where draw() has drawn the ridge line: a row for each column of the picture, which may be
  // outside of it. Row 0.0 is the middle of the topmost pixels.
  const std::vector<float>& ridge_rows_px() const { return ridge_row_; }
  // Elevation of the ridge line at an azimuth.
  double ridge_rad(double azimuth_rad) const;

 private:
  struct Node {   // of the coarse grid, exact through the camera
    float u = 0;  // texels of the slopes' texture, growing with azimuth
    float v = 0;  // growing downwards
  };
  void compute_nodes(const Eigen::Matrix3d& R_enu_cam);
  Node node_at(float x, float y) const;
  void draw_sky(int end, cv::Mat& gray) const;  // rows before `end`
  void find_ridge_rows();
  // Rows from `first` contain slopes, rows from `pure` only slopes.
  void draw_slopes(int first, int pure, cv::Mat& gray) const;
  void sample_row(int y, std::uint8_t* out) const;
  void blend_row(int y, const std::uint8_t* in, std::uint8_t* out) const;

  void compute_rays();

  CameraIntrinsics camera_;
  float px_per_texel_ = 1.0F;
  double made_for_px_ = 0.0;  // focal length
  double texels_per_rad_ = 0.0;
  cv::Mat slopes_;            // 8-bit, its period repeated once in both directions
  cv::Mat sky_;               // float, whole panorama, coarse
  std::vector<float> ridge_;  // elevation in texels, for each texel of azimuth

  // Per image.
  int columns_ = 0, rows_ = 0;             // of the grid
  std::vector<Eigen::Vector3d> rays_cam_;  // of the grid's nodes
  std::vector<Node> nodes_;
  double u_origin_ = 0.0, v_origin_ = 0.0;  // texels, subtracted from the nodes
  std::vector<float> ridge_row_;            // of each image column
};

}  // namespace ols::sim
