// The background of an image: wooded slopes below a ridge line, with sky and clouds above.
// Everything is at infinity: the image of the background moves by the homography of the camera's
// rotation.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <opencv2/core.hpp>
#include <vector>

#include "geometry/lens.h"
#include "sim/scenario/scenario.h"

namespace ols::sim {

// The texture of the wooded slopes, with a resolution for this camera. Takes about a second.
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
  // Draws the background of an image. `R_enu_cam`: the camera's rotation, from camera axes to east,
  // north, up.
  void draw(const Eigen::Matrix3d& R_enu_cam, cv::Mat& gray);

  // Raises the ridge line to the skyline of the near land, where that is higher. `skyline_rad`: the
  // elevation [rad] by azimuth.
  void raise(const std::function<double(double azimuth_rad)>& skyline_rad);

  // Where draw() has drawn the ridge line: one row for each column of the picture. The row may be
  // outside of the picture; row 0.0 is the middle of the topmost pixels.
  const std::vector<float>& ridge_rows_px() const { return ridge_row_; }
  // The elevation of the ridge line at an azimuth.
  double ridge_rad(double azimuth_rad) const;

 private:
  struct Node {   // a node of the coarse grid, projected exactly
    float u = 0;  // texel of the slopes' texture, increases with azimuth
    float v = 0;  // increases downwards
  };
  void compute_nodes(const Eigen::Matrix3d& R_enu_cam);
  Node node_at(float x, float y) const;
  void draw_sky(int end, cv::Mat& gray) const;  // the rows above `end`
  void find_ridge_rows();
  // Rows from `first` on contain slopes; rows from `pure` on contain only slopes.
  void draw_slopes(int first, int pure, cv::Mat& gray) const;
  void sample_row(int y, std::uint8_t* out) const;
  void blend_row(int y, const std::uint8_t* in, std::uint8_t* out) const;

  void compute_rays();

  CameraIntrinsics camera_;
  float px_per_texel_ = 1.0F;
  double made_for_px_ = 0.0;  // focal length at construction
  double texels_per_rad_ = 0.0;
  cv::Mat slopes_;            // 8-bit; one period, repeated once in both directions
  cv::Mat sky_;               // float, coarse, of the whole panorama
  std::vector<float> ridge_;  // elevation in texels, for each texel of azimuth

  // Per image.
  int columns_ = 0, rows_ = 0;             // of the grid
  std::vector<Eigen::Vector3d> rays_cam_;  // lines of sight of the grid's nodes
  std::vector<Node> nodes_;
  double u_origin_ = 0.0, v_origin_ = 0.0;  // texels, subtracted from the nodes
  std::vector<float> ridge_row_;            // of each image column
};

}  // namespace ols::sim
