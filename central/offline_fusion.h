// Fusion of recorded bearings: all of them are at hand, so each epoch is interpolated between the
// bearings on both sides of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "central/fusion.h"

namespace ols {

enum class OfflineEstimator { kLeastSquares, kPaper, kPaperBestBaseline };
std::optional<OfflineEstimator> offline_estimator(std::string_view name);

struct OfflineConfig {
  OfflineEstimator estimator = OfflineEstimator::kLeastSquares;
  double rate_hz = 0.0;    // epochs on an even grid; 0: at the instant of every bearing
  int moving_average = 1;  // estimates that are averaged; 1: none, the paper's is 10
  int passes = 3;          // the first ones learn what the bearings' covariances leave out
  FusionConfig fusion{};   // what it shares with the live one
};

// What fuse_offline leaves out before it looks at the geometry.
struct UnusedBearings {
  std::size_t low_belief = 0;
  std::size_t duplicate = 0;  // the same station and stamp: the first is taken
};
UnusedBearings unused_bearings(const std::vector<Sighting>& sightings, const OfflineConfig& config);

// One target's bearings, in any order. Targets with a position only, in order of time. Bearings
// that check() refuses must not be among them. std::invalid_argument for a rate that is not finite
// or makes more than ten million epochs.
std::vector<FusedTarget> fuse_offline(const std::vector<Sighting>& sightings,
                                      const OfflineConfig& config);

}  // namespace ols
