// Finds confirmed tracks that are duplicates: only noise distinguishes their bearings. Pure.
//
// A station that sees two objects has two bearings in most exposures. A station that sees one
// object has one bearing; both tracks explain it, or now one and now the other. Therefore, for each
// pair of tracks that have explained the same bearing, three numbers are counted per station:
// exposures with one bearing for the two tracks, how many of those bearings both tracks explain,
// and exposures with more bearings.
//
// A station that follows a single object never has more than one bearing. Two real objects then
// differ from a duplicate in two ways: they are apart in some station's view, and it is always the
// same track that explains a station's bearings best.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "central/measurement/bearing_measurement.h"

namespace ols::fusion {

struct DuplicatesConfig {
  double long_s = 1.0;         // min duration
  double memory_s = 1.0;       // older exposures count less than 1/e
  double least_single = 15.0;  // min number of exposures with one bearing for the two
  double most_apart = 0.05;    // max share of exposures with more bearings
  double both_explain = 0.3;   // min share of each station's bearings that both tracks explain
  double each_best = 0.15;     // min share, for most stations, that either track explains best
};

class DuplicateTracks {
 public:
  explicit DuplicateTracks(const DuplicatesConfig& config = {}) : config_(config) {}

  // Takes a bearing, and the confirmed tracks that explain it and have no other bearing of its
  // exposure, best first. The bearing counts for the pairs that contain the best track.
  void note(const BearingMeasurement& measurement, std::span<const std::int64_t> tracks);
  // Pairs that are duplicates, the older identity first.
  std::vector<std::pair<std::int64_t, std::int64_t>> same() const;
  void forget(std::int64_t track);
  bool empty() const { return pairs_.empty(); }

 private:
  // The exposures of one station.
  struct Tally {
    std::int64_t utime_us = 0;  // of the newest one,
    int bearings = 0;           // bearings of the newest exposure for the two
    bool shared = false;        // whether both explain one of them
    bool first = false;         // whether the first of the two explains it best
    double single = 0.0, both_explain = 0.0, first_best = 0.0, apart = 0.0;  // of the earlier ones
  };
  struct Pair {
    std::int64_t since_us = 0, newest_us = 0;
    std::map<std::string, Tally> stations;
  };
  void count(Pair& pair, const BearingMeasurement& measurement, bool shared, bool first) const;
  bool are_same(const Pair& pair) const;

  DuplicatesConfig config_;
  std::map<std::pair<std::int64_t, std::int64_t>, Pair> pairs_;
};

}  // namespace ols::fusion
