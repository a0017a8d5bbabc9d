// Draws the image of one station's camera at the true angles of its PTU, and returns the truth
// about the target in it.
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "sim/scenario/faults.h"
#include "sim/world/boards.h"
#include "sim/world/flyer.h"
#include "sim/world/panorama.h"
#include "sim/world/sun.h"
#include "sim/world/world.h"

namespace ols::sim {

struct ExposureTruth {
  double mid_s = 0.0;  // true time since the scenario's start
  double exposure_s = 0.0;
  PanTilt start, mid, end;  // shaft angles [rad] at those instants, continuous
  std::uint64_t frame = 0;
  double zoom = 0.0;   // position of a zoom lens, 0: widest .. 1: longest
  double light = 1.0;  // brightness by exposure and gain; 1: the scenario's exposure without gain
  ByHand by_hand;
  std::optional<SunTruth> sun;  // nullopt: the sun is not visible
};

struct ViewTruth {
  bool visible = false;  // the target's centre is inside the image and not hidden by the land
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
  cv::Rect2d box;
  double px_per_m = 0.0;  // scale of the image at the target's centre, across the line of sight
};

// The intrinsics of a station's camera during an exposure.
CameraIntrinsics camera_of(const StationTruth& station, const ExposureTruth& exposure);

// The truth about a target in an image, without drawing the image.
ViewTruth view_truth(const World& world, std::size_t station, const ExposureTruth& exposure,
                     std::size_t target = 0);

// One renderer for each station of the world.
class Renderer;
std::vector<std::unique_ptr<Renderer>> make_renderers(const World& world);

class Renderer {
 public:
  // `world` must outlive the renderer; `slopes` as for Panorama.
  Renderer(const World& world, std::size_t station, const cv::Mat& slopes);

  // Draws the image. The same exposure gives the same image, except for rectification targets:
  // their place depends on the first exposure in which they appeared.
  ViewTruth draw(const ExposureTruth& exposure, cv::Mat& gray);

  const Panorama& panorama() const { return panorama_; }

 private:
  void draw_scene(const ExposureTruth& exposure, cv::Mat& gray);
  // Removes the parts of a target that the land in front of it hides.
  void cover(const ExposureTruth& exposure, const Eigen::Vector3d& target_ecef,
             FlyerMatte& matte) const;
  void draw_marks(const ExposureTruth& exposure, cv::Mat& gray) const;
  void draw_sky_light(const ExposureTruth& exposure, cv::Mat& gray) const;
  void smear(const ExposureTruth& exposure, cv::Mat& gray) const;
  void develop(const ExposureTruth& exposure, cv::Mat& gray) const;

  const World& world_;
  std::size_t station_;
  Panorama panorama_;
  Boards boards_;
  std::vector<std::int16_t> noise_;         // a long strip of noise, read from random positions
  std::vector<std::uint16_t> column_gain_;  // of the row through the image's centre
  std::vector<std::uint16_t> row_falloff_;
};

}  // namespace ols::sim
