// A target at a known position, drawn by the simulator, and the Cramer-Rao bound of that position.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace ols::bench {

struct TargetLook {
  double width_px = 16.0;  // of the target's silhouette
  // Largest difference from the sky, in standard deviations of the pixel noise; 0: the simulator's
  // own contrast.
  double contrast_sigma = 20.0;
  double blur_px = 0.7;  // standard deviation of the lens's blur
};

inline constexpr double kSkyLevel = 190.0;  // [gray levels]
inline constexpr double kNoiseSd = 2.0;     // [gray levels] 1-sigma of every pixel

class SyntheticTarget {
 public:
  explicit SyntheticTarget(const TargetLook& look);

  // Draws the target into an image (float, gray levels). `centre_px`: (0, 0) is the centre of the
  // top-left pixel. `smear_px`: how far the target moves during the exposure. `growth`: the
  // target's size over that of its TargetLook.
  void draw(cv::Mat1f& picture, const Eigen::Vector2d& centre_px, const Eigen::Vector2d& smear_px,
            double growth) const;

  // The box with which a tracker starts, given by pixel edges: the silhouette with a margin of half
  // a pixel.
  cv::Rect2d box(const Eigen::Vector2d& centre_px) const;

  // Cramer-Rao bound of the centre's covariance [px^2] in one image, if everything else is known:
  // the inverse of J'J / sigma^2. J contains the derivatives of the noise-free image with respect
  // to the centre.
  Eigen::Matrix2d bound(const cv::Mat1f& backdrop, const Eigen::Vector2d& centre_px,
                        const Eigen::Vector2d& smear_px, double growth) const;

 private:
  TargetLook look_;
  double px_per_m_ = 1.0;
  double strength_ = 1.0;  // factor of the target's difference from the sky
};

}  // namespace ols::bench
