#include "edge/skyline/seen_horizon.h"

#include <algorithm>
#include <cmath>

#include "geometry/angles.h"

namespace ols::skyline {

SeenHorizon::SeenHorizon(double anew_rad) : anew_rad_(anew_rad), means_(kColumns) {}

void SeenHorizon::clear() { means_.assign(kColumns, {}); }

void SeenHorizon::Mean::add(double azimuth, double elevation, double variance_rad2,
                            double of_azimuth_rad2) {
  pictures = std::min(pictures + 1, kMost);
  const double share = 1.0 / pictures, off_rad = elevation - elevation_rad;
  if (pictures == 1) azimuth_rad = azimuth;
  azimuth_rad += share * (azimuth - azimuth_rad);
  elevation_rad += share * off_rad;
  picture_variance_rad2 += share * (variance_rad2 - picture_variance_rad2);
  azimuth_variance_rad2 += share * (of_azimuth_rad2 - azimuth_variance_rad2);
  if (pictures > 1) scatter_rad2 += share * (off_rad * off_rad * (1.0 - share) - scatter_rad2);
}

void SeenHorizon::add(const std::vector<SkylinePoint>& picture, double time_s,
                      double azimuth_sd_rad) {
  struct Sum {
    int count = 0;
    double azimuth_rad = 0.0, elevation_rad = 0.0, variance_rad2 = 0.0;
  };
  constexpr double kColumn_rad = 2.0 * kPi / kColumns;
  std::vector<Sum> sums(kColumns);
  for (const SkylinePoint& point : picture) {
    const double azimuth_rad = wrap_two_pi(point.direction.azimuth_rad);
    const auto column = std::min(kColumns - 1, static_cast<int>(azimuth_rad / kColumn_rad));
    Sum& sum = sums[static_cast<std::size_t>(column)];
    ++sum.count;
    sum.azimuth_rad += azimuth_rad;
    sum.elevation_rad += point.direction.elevation_rad;
    sum.variance_rad2 += point.sd_rad * point.sd_rad;
  }
  newest_s_ = time_s;
  for (std::size_t column = 0; column < sums.size(); ++column) {
    const Sum& sum = sums[column];
    if (sum.count == 0) continue;
    Mean& mean = means_[column];
    const double elevation_rad = sum.elevation_rad / sum.count;
    if (is_old(mean) || std::abs(elevation_rad - mean.elevation_rad) > anew_rad_) mean = {};
    if (mean.pictures == 0) mean.oldest_s = time_s;
    mean.newest_s = time_s;
    // Neighbouring strips err alike: their number does not make the mean better.
    mean.add(sum.azimuth_rad / sum.count, elevation_rad, sum.variance_rad2 / sum.count,
             azimuth_sd_rad * azimuth_sd_rad);
  }
}

std::vector<SeenPlace> SeenHorizon::places() const {
  std::vector<SeenPlace> places;
  for (const Mean& mean : means_) {
    if (mean.pictures == 0 || is_old(mean)) continue;
    places.push_back({{mean.azimuth_rad, mean.elevation_rad},
                      std::max(mean.picture_variance_rad2, mean.scatter_rad2) / mean.pictures,
                      mean.azimuth_variance_rad2,
                      mean.newest_s,
                      mean.oldest_s,
                      mean.pictures});
  }
  return places;
}

}  // namespace ols::skyline
