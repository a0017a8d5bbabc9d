// Makes the two outputs that contain the unit's counts: sightings, and frames on request. Requested
// frames are encoded and divided into parts that fit into datagrams.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edge/clock/clock_pair.h"
#include "edge/frames/frame_post.h"
#include "edge/frames/frame_service.h"
#include "edge/frames/sighting_desk.h"

namespace ols::station {

struct FramePart {
  std::shared_ptr<const EncodedFrame> frame;
  // UTC of mid-exposure. It is the same in all parts of a frame, so that a receiver can join them.
  std::int64_t utime_us = 0;
  std::size_t part = 0, parts = 0;
  std::size_t first_byte = 0, bytes = 0;
};

class FrameDesk {
 public:
  // Maximum size of a part. A datagram has at most about 65 000 bytes; the difference is left for
  // the header.
  static constexpr std::size_t kPart_bytes = 60000;

  FrameService& service() { return service_; }
  // Passes the requested frames to the encoder, and divides the next encoded frame into parts.
  // Never waits.
  void look(const clock::ClockPair& now, const PointingModel& unit);
  // The next part to be sent; nullopt if there is none.
  std::optional<FramePart> next();
  // Call in the order of the bearings' times. Returns the sightings that are to be published now.
  std::vector<Sighting> sightings(const Bearing& bearing, std::int64_t utime_us,
                                  const PointingModel& unit) {
    return sightings_.take(bearing, utime_us, unit);
  }

 private:
  FrameService service_;
  FramePost post_;
  SightingDesk sightings_;
  std::deque<FramePart> parts_;  // parts of one frame
};

}  // namespace ols::station
