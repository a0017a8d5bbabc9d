// How the mount has turned, as the camera's pictures show it: the sum of the turns from picture to
// picture. Pure.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>

#include "geometry/kinematic_chain.h"

namespace ols::mount {

// The mount's turn between two pictures.
struct SeenTurn {
  double from_s = 0.0, to_s = 0.0;  // their mid-exposures, on the station's monotonic clock
  // How much later than mid-exposure the rows in which the turn was seen were exposed; 0 for a
  // global shutter.
  double row_s = 0.0;
  double stamp_sd_s = 0.0;  // 1-sigma of an error that the instants of all pictures share
  PanTilt turn;
  PanTilt sd;  // [rad] 1-sigma, independent from turn to turn
};

class SeenPath {
 public:
  explicit SeenPath(double span_s) : span_s_(span_s) {}

  enum class Added { kContinued, kBegun, kIgnored };
  // A turn continues the path from the picture at which it begins. If that picture is not in the
  // path, the path begins anew. A turn that ends before the path does is ignored.
  Added add(const SeenTurn& turn);
  void clear() { knots_.clear(); }

  struct At {
    double time_s = 0.0;
    PanTilt turned;  // [rad] since the path began
    PanTilt rate;    // [rad/s]
    PanTilt walk;    // [rad^2] variance of `turned`, a random walk from the path's beginning
    PanTilt bend;    // [rad^2] variance at this instant, as the rate changes between pictures
  };
  // nullopt before the path, and more than one picture interval after its end.
  std::optional<At> at(double time_s) const;
  bool covers(double time_s) const { return !knots_.empty() && time_s <= knots_.back().time_s; }

 private:
  struct Knot {
    double picture_s, time_s;  // mid-exposure of the picture; instant of the angle
    PanTilt turned, walk;
  };
  double rate(std::size_t right, double PanTilt::*axis) const;
  double acceleration(std::size_t right, double PanTilt::*axis) const;

  double span_s_;
  std::deque<Knot> knots_;
};

}  // namespace ols::mount
