// The contents of a file, independent of its format: tracks, stations, and stations' lines of
// sight. Pure.
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <map>
#include <string>

#include "export/records.h"

namespace ols::exports {

struct PictureLimits {
  double history_s = std::numeric_limits<double>::infinity();
  // Limit of the points of all tracks and lines together. To keep this limit, the points of each
  // track and line are spaced more widely in time.
  std::int64_t most_points = std::numeric_limits<std::int64_t>::max();
  // Skips objects whose height above sea level is unknown, for formats that have no other height.
  bool needs_sea = false;
};

struct Track {
  Target last;
  std::deque<Target> points;  // ascending in time
};
struct SeenLines {
  std::deque<Line> points;
};

class Picture {
 public:
  explicit Picture(PictureLimits limits = {}) : limits_(limits) {}

  void take(const Target& target);
  void take(const Station& station);
  void take(const Line& line);
  // Removes points older than the history, except an object's newest point while the object is
  // alive. Also removes tracks that ended before the history, and stations that were silent for
  // five minutes. `utime_us`: now.
  void forget(std::int64_t utime_us);

  bool is_empty() const { return tracks_.empty() && stations_.empty() && lines_.empty(); }
  const std::map<std::string, Track>& tracks() const { return tracks_; }
  const std::map<std::string, Station>& stations() const { return stations_; }
  const std::map<std::string, SeenLines>& lines() const { return lines_; }

 private:
  bool fits(const Place& place) const;
  std::int64_t history_us() const;
  std::int64_t spacing_us() const;

  PictureLimits limits_;
  std::map<std::string, Track> tracks_;
  std::map<std::string, Station> stations_;
  std::map<std::string, SeenLines> lines_;
};

// The point on a line of sight at this distance from the camera.
Place end_of(const Line& line, double distance_m);

}  // namespace ols::exports
