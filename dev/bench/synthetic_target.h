// A target at a known place, drawn by the simulator, and how well any tracker could know that
// place.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace ols::bench {

struct TargetLook {
  double width_px = 16.0;  // of its silhouette
  // Greatest difference from the sky, in standard deviations of the pixel noise; 0: the natural
  // one.
  double contrast_sigma = 20.0;
  double blur_px = 0.7;  // standard deviation of the lens's blur
};

inline constexpr double kSkyLevel = 190.0;  // [gray levels]
inline constexpr double kNoiseSd = 2.0;     // [gray levels] of every pixel

class SyntheticTarget {
 public:
  explicit SyntheticTarget(const TargetLook& look);

  // Draws it into an image (float, gray levels). `centre_px`: (0, 0) is the centre of the top-left
  // pixel. `smear_px`: how far it moves during the exposure. `growth`: its size over that of the
  // look.
  void draw(cv::Mat1f& picture, const Eigen::Vector2d& centre_px, const Eigen::Vector2d& smear_px,
            double growth) const;

  // A box on pixel edges, for a tracker's start: the silhouette and half a pixel around it.
  cv::Rect2d box(const Eigen::Vector2d& centre_px) const;

  // Cramer-Rao bound of the centre's covariance [px^2] in one such image, if all else is known: the
  // inverse of J'J / sigma^2. J holds the derivatives of the noise-free image.
  Eigen::Matrix2d bound(const cv::Mat1f& backdrop, const Eigen::Vector2d& centre_px,
                        const Eigen::Vector2d& smear_px, double growth) const;

 private:
  TargetLook look_;
  double px_per_m_ = 1.0;
  double strength_ = 1.0;  // of its difference from the sky
};

}  // namespace ols::bench
