// A textured three-dimensional world, and the panoramas of it that stations see from several
// places, with the true range of every pixel. Pure.
//
// The world is real relief with the errors that its model is stated to have, roughness, trees,
// houses and masts. No model has these. Brightness belongs to places of the world, so that two
// stations see the same surface. Trees are clusters of balls, houses and masts are convex bodies
// with plane faces, so that each looks different from another direction.
//
// Axes: east, north, up at the middle between the stations [m].
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <random>
#include <vector>

namespace ols::bench {

struct Ball {
  Eigen::Vector3f centre;
  float radius_m = 0.5F;
  float albedo = 0.3F;
};

// The space behind all faces.
struct Body {
  struct Face {
    Eigen::Vector3f normal;  // outwards
    float offset_m = 0.0F;   // normal . point <= offset
    float albedo = 0.5F;
    bool windows = false;
  };
  std::vector<Face> faces;
  Eigen::Vector3f centre;
  float reach_m = 0.0F;  // all of it is within this distance of its centre
};

// Heights on a square lattice.
struct HeightLattice {
  Eigen::Vector2d south_west_m;
  double pitch_m = 2.0;
  cv::Mat1f heights_m;  // rows from the south

  bool covers(double x, double y) const;
  float at(double x, double y) const;
};

struct SceneryWorld {
  HeightLattice near, far;  // the near one is the finer one
  std::vector<Ball> balls;
  std::vector<Body> bodies;
  std::uint64_t seed = 1;

  // NaN outside.
  double ground_m(double x, double y) const;
};

// Of a panorama's raster. Row 0.0 is the middle of the topmost pixels.
struct PanoramaRaster {
  double first_azimuth_rad = 0.0, top_elevation_rad = 0.0;  // the middle of the first pixel
  double rad_per_px = 0.0;
  cv::Size size;
};

struct DrawnPanorama {
  cv::Mat1b gray;
  cv::Mat1f range_m;  // infinite for sky
};

struct Exposure {
  double gain = 1.0, offset = 0.0;    // of the brightness
  double blur_px = 0.6, noise = 2.0;  // 1-sigma
};

DrawnPanorama draw_panorama(const SceneryWorld& world, const Eigen::Vector3d& camera,
                            const PanoramaRaster& raster, const Exposure& exposure,
                            std::uint64_t seed);

struct WorldPlan {
  int trees = 4000, houses = 120, masts = 60, bushes = 3000;
  double within_m = 600.0, from_m = 350.0, to_m = 4000.0;  // about the line of view
};

// `ground`: the true height at a place. `along`: unit vector of the line of view.
SceneryWorld make_world(const std::function<double(double x, double y)>& ground,
                        const Eigen::Vector2d& along, const WorldPlan& plan, std::uint64_t seed);

}  // namespace ols::bench
