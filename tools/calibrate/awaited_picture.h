// A picture that is awaited from given angles, to which the unit was sent: how near the unit is to
// these angles, which parts of the picture have arrived, and what is missing. Uses no clock and no
// bus: the caller gives the times [s, monotonic].
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "geometry/kinematic_chain.h"
#include "ols_msg/frame_part_t.hpp"

namespace ols::calibration {

class AwaitedPicture {
 public:
  AwaitedPicture(std::int64_t boot_id, const PanTilt& at, double now_s)
      : boot_id_(boot_id), at_(at), progress_s_(now_s), part_s_(now_s) {}

  const PanTilt& at() const { return at_; }
  // The picture was requested with this sequence number. After a second request, an answer to the
  // first one is still accepted.
  void asked(std::int64_t sequence) { first_request_ = std::min(first_request_, sequence); }
  void hear_angles(const PanTilt& angles, double now_s);
  // Takes a part; returns the picture's file if it is now complete. Ignores parts that answer other
  // requests. Parts of a newer frame replace those of an older one.
  std::optional<std::vector<std::uint8_t>> hear_part(const ols_msg::frame_part_t& part,
                                                     double now_s);

  double part_heard_s() const { return part_s_; }
  // When the unit last came nearer, or another part of the picture last arrived.
  double progress_s() const { return progress_s_; }
  std::string missing() const;

 private:
  // [rad] The unit has arrived if it is no farther from the angles than this, a quarter of the
  // length of an approach.
  static constexpr double kThere_rad = 2e-3;

  std::int64_t boot_id_;  // of the requester
  PanTilt at_;
  double progress_s_, part_s_;
  double nearest_rad_ = std::numeric_limits<double>::infinity();
  std::optional<PanTilt> angles_;
  std::int64_t first_request_ = std::numeric_limits<std::int64_t>::max();
  std::int64_t frame_utime_us_ = 0;
  std::size_t parts_in_frame_ = 0, most_parts_ = 0;
  std::map<int, std::vector<std::uint8_t>> parts_;
};

}  // namespace ols::calibration
