// Judges by the turns between pictures whether the camera moves. Pure.
//
// Wind sways a mast to and fro, so only a turn that adds up counts. One picture may be misjudged,
// for example when the light changes, so the largest turn does not count. Clouds that fill the
// picture drift, so a slow turn does not count.
#pragma once

#include <deque>

#include "edge/mount/seen_path.h"

namespace ols::mount {

class PictureMotion {
 public:
  // `tilt_rad`: the mount's tilt, because near the vertical a large turn of pan moves the picture
  // only a little. A turn that overlaps an earlier one is ignored.
  void add(const SeenTurn& turn, double tilt_rad);

  enum class Is { kUnknown, kAtRest, kMoving };
  // By the pictures of the last 1.5 s, as far as they were exposed since `since_s`.
  Is judge(double since_s) const;
  // Whether the camera turned by less than `least_rad` since then, at most eight seconds ago; false
  // if the pictures since then have a gap or cover less than 1.2 s.
  bool stood(double since_s, double least_rad) const;

 private:
  struct Sum;   // of the turns of one axis
  struct Sums;  // of both
  using Turns = std::deque<SeenTurn>;
  Sums sums(Turns::const_iterator first) const;

  Turns turns_;
};

}  // namespace ols::mount
