// Makes the outputs that contain the unit's counts: sightings and requested frames. Handles a frame
// from the request to the parts that fit into datagrams.
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
  // Mid-exposure; it is the same in all parts, so that they can be joined.
  std::int64_t utime_us = 0;
  std::size_t part = 0, parts = 0;
  std::size_t first_byte = 0, bytes = 0;
};

class FrameDesk {
 public:
  // Below 65 000, which leaves space for the header.
  static constexpr std::size_t kPart_bytes = 60000;

  FrameService& service() { return service_; }
  // Passes completed frames on to the encoder; never waits.
  void look(const clock::ClockPair& now, const PointingModel& unit);
  std::optional<FramePart> next();
  // Call in order of time. Returns the sightings that are to be published now.
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
