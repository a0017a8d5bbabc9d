// Averages the skyline that a station's recent pictures show, for each azimuth. Pure.
#pragma once

#include <limits>
#include <vector>

#include "edge/skyline/expected_skyline.h"

namespace ols::skyline {

// One azimuth of the seen skyline, computed with the station's heading and tilt.
struct SeenPlace {
  AzimuthElevation direction;
  double variance_rad2 = 0.0;  // variance of the elevation, from the pictures alone
  // Variance of the azimuth, as stated by the station. The azimuths of all places may have the same
  // error.
  double azimuth_variance_rad2 = 0.0;
  double newest_s = 0.0;  // time of its newest picture
  double oldest_s = 0.0;  // time of its first picture
  int pictures = 1;       // number of pictures in the mean; at most SeenHorizon::kMost
};

// Several pictures of the same place are averaged. This reduces the noise of the pictures, but not
// the error of the model of the land. New pictures replace old ones, because somebody may knock the
// tripod.
class SeenHorizon {
 public:
  // If a picture shows a place more than `anew_rad` above or below the mean of that place, the mean
  // begins anew.
  explicit SeenHorizon(double anew_rad = std::numeric_limits<double>::infinity());

  // Adds a picture; call it in the order of the pictures' times [s]. `azimuth_sd_rad`: 1-sigma that
  // the station states for the picture's azimuths.
  void add(const std::vector<SkylinePoint>& picture, double time_s, double azimuth_sd_rad);
  void clear();
  // The places in the order of their azimuths. Places that no picture has shown during the last
  // kMemory_s before the newest picture are left out.
  std::vector<SeenPlace> places() const;

  static constexpr int kColumns = 7200;  // as many as a land::HorizonMap has
  // The newest picture of a place has at least the weight 1 / kMost in the mean.
  static constexpr int kMost = 5;
  static constexpr double kMemory_s = 1800.0;

 private:
  struct Mean {
    int pictures = 0;
    double newest_s = 0.0, oldest_s = 0.0;
    double azimuth_rad = 0.0, elevation_rad = 0.0;
    double picture_variance_rad2 = 0.0;
    double scatter_rad2 = 0.0;  // variance from picture to picture
    double azimuth_variance_rad2 = 0.0;
    void add(double azimuth, double elevation, double variance_rad2, double of_azimuth_rad2);
  };
  bool is_old(const Mean& mean) const { return newest_s_ - mean.newest_s > kMemory_s; }

  double anew_rad_;
  std::vector<Mean> means_;
  double newest_s_ = 0.0;
};

}  // namespace ols::skyline
