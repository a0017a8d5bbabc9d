// Finds confirmed tracks that are duplicates: two tracks of one object, whose bearings differ only
// by noise. Pure.
//
// A station that sees two objects has two bearings in most exposures. A station that sees one
// object has one bearing, which both tracks explain, or sometimes one track and sometimes the
// other. For each pair of tracks that have explained the same bearing, three numbers are therefore
// counted for each station: exposures with one bearing for the two tracks, those of them whose
// bearing both tracks explain, and exposures with more bearings.
//
// Some stations follow a single object and never have more than one bearing. The tracks are
// therefore two real objects in two cases: they are apart in some station's view, or one and the
// same track always explains a station's bearings best.
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
  double long_s = 1.0;         // smallest duration
  double memory_s = 1.0;       // exposures older than this count less than 1/e
  double least_single = 15.0;  // smallest number of exposures with one bearing for the two tracks
  double most_apart = 0.05;    // largest share of exposures with more bearings
  double both_explain = 0.3;   // smallest share of each station's bearings that both tracks explain
  // Smallest share that each of the two tracks explains best, for most stations.
  double each_best = 0.15;
};

class DuplicateTracks {
 public:
  explicit DuplicateTracks(const DuplicatesConfig& config = {}) : config_(config) {}

  // Takes a bearing, and the confirmed tracks that explain it and have no other bearing of this
  // exposure, best first. The bearing counts for the pairs that contain the best track.
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
    bool shared = false;        // both tracks explain one of them
    bool first = false;         // the first of the two tracks explains it best
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
