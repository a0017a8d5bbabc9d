// The skyline as a station's pictures have shown it so far, by azimuth. Pure.
#pragma once

#include <vector>

#include "edge/skyline/expected_skyline.h"

namespace ols::skyline {

// One azimuth of the seen skyline, as the station's heading and tilt have it.
struct SeenPlace {
  AzimuthElevation direction;
  double variance_rad2 = 0.0;  // of the elevation, from the pictures alone
};

// Several pictures of the same place are averaged: the noise of pictures becomes smaller, the error
// of a model of the land does not.
class SeenHorizon {
 public:
  SeenHorizon();

  void add(const std::vector<SkylinePoint>& picture);
  void clear();
  // In the order of their azimuths.
  std::vector<SeenPlace> places() const;

  static constexpr int kColumns = 7200;  // as many as a map has

 private:
  struct Mean {
    int pictures = 0;
    double azimuth_rad = 0.0, elevation_rad = 0.0;
    double picture_variance_rad2 = 0.0;
    double scatter_rad2 = 0.0;  // variance from picture to picture
    void add(double azimuth, double elevation, double variance_rad2);
  };
  std::vector<Mean> means_;
};

}  // namespace ols::skyline
