// The mount's rotation over time as the camera's pictures show it: the sum of the rotations from
// picture to picture. Pure.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>

#include "geometry/kinematic_chain.h"

namespace ols::mount {

// The mount's rotation between two pictures.
struct SeenTurn {
  // Mid-exposures of the two pictures, on the station's monotonic clock.
  double from_s = 0.0, to_s = 0.0;
  // For a rolling shutter: the rows in which the rotation was measured were exposed this long after
  // from_s and to_s. 0 for a global shutter.
  double row_s = 0.0;
  double stamp_sd_s = 0.0;  // 1-sigma of an error that the stamps of all pictures share
  PanTilt turn;
  PanTilt sd;  // [rad] 1-sigma of `turn`; independent from turn to turn
};

class SeenPath {
 public:
  explicit SeenPath(double span_s) : span_s_(span_s) {}

  enum class Added { kContinued, kBegun, kIgnored };
  // Adds a turn to the path at the picture from_s. If this picture is not in the path, the path
  // begins anew with this turn. A turn whose to_s is not later than the path's end is ignored.
  Added add(const SeenTurn& turn);
  void clear() { knots_.clear(); }

  struct At {
    double time_s = 0.0;
    PanTilt turned;  // [rad] since the path began
    PanTilt rate;    // [rad/s]
    PanTilt walk;    // [rad^2] variance of `turned`: a random walk that begins with the path
    // [rad^2] additional variance at this instant, because the rate may change between pictures
    PanTilt bend;
  };
  // The rotation at an instant; nullopt before the path's beginning, and later than one picture
  // interval after its end.
  std::optional<At> at(double time_s) const;
  bool covers(double time_s) const { return !knots_.empty() && time_s <= knots_.back().time_s; }

 private:
  struct Knot {
    double picture_s, time_s;  // mid-exposure; picture_s + row_s, the instant of `turned`
    PanTilt turned, walk;
  };
  double rate(std::size_t right, double PanTilt::*axis) const;
  double acceleration(std::size_t right, double PanTilt::*axis) const;

  double span_s_;
  std::deque<Knot> knots_;
};

}  // namespace ols::mount
