// Finds confirmed tracks that are duplicates: two tracks of one object, whose bearings differ only
// by noise. Pure.
//
// A station that sees two objects has two bearings in most exposures. A station that sees one
// object has one bearing. Either both tracks explain it, or sometimes one track explains it and
// sometimes the other. Pairs of tracks that have explained the same bearing are therefore examined.
// For each pair and each station, three numbers are counted: the exposures with a single bearing
// for the two tracks, the exposures whose single bearing both tracks explain, and the exposures
// with more than one bearing.
//
// Some stations follow a single object and never have more than one bearing. The tracks therefore
// count as two objects, not as duplicates, in two cases. Either a station sees them apart: both
// tracks explain only a small share of its bearings. Or at half or more of the stations, one of the
// two tracks almost always explains the bearings best.
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
  double long_s = 1.0;         // shortest time since the pair was first noted
  double memory_s = 1.0;       // exposures older than this count less than 1/e
  double least_single = 15.0;  // smallest number of exposures with one bearing for the two tracks
  double most_apart = 0.05;    // largest share of exposures with more bearings
  double both_explain = 0.3;   // smallest share of each station's bearings that both tracks explain
  // At the majority of the stations, each of the two tracks must explain at least this share of
  // bearings best.
  double each_best = 0.15;
};

class DuplicateTracks {
 public:
  explicit DuplicateTracks(const DuplicatesConfig& config = {}) : config_(config) {}

  // Takes a bearing. `tracks`: the confirmed tracks that explain it and have no other bearing of
  // this exposure, best first. The bearing is counted for the pairs that contain the best track.
  void note(const BearingMeasurement& measurement, std::span<const std::int64_t> tracks);
  // Pairs of duplicates; the older identity comes first.
  std::vector<std::pair<std::int64_t, std::int64_t>> same() const;
  void forget(std::int64_t track);
  bool empty() const { return pairs_.empty(); }

 private:
  // Counts over the exposures of one station.
  struct Tally {
    std::int64_t utime_us = 0;  // time of the newest exposure
    int bearings = 0;           // number of the newest exposure's bearings for the two tracks
    bool shared = false;        // both tracks explain one of these bearings
    bool first = false;  // the first of the two tracks explains the first of these bearings best
    // Counts over the earlier exposures.
    double single = 0.0, both_explain = 0.0, first_best = 0.0, apart = 0.0;
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
