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

 private:
  std::deque<SeenTurn> turns_;
};

}  // namespace ols::mount
