// The outputs that contain the unit's counts: sightings, and requested frames, from the request to
// the parts that fit into datagrams.
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
  std::int64_t utime_us = 0;  // mid-exposure; the same in all parts, to join them
  std::size_t part = 0, parts = 0;
  std::size_t first_byte = 0, bytes = 0;
};

class FrameDesk {
 public:
  static constexpr std::size_t kPart_bytes = 60000;  // leaves space for the header, below 65 000

  explicit FrameDesk(const mount::AngleHistory::Config& history) : service_(history) {}

  FrameService& service() { return service_; }
  // Passes on completed frames; never waits.
  void look(const clock::ClockPair& now);
  std::optional<FramePart> next();
  // In time order. Returns the sightings to be published now.
  std::vector<Sighting> sightings(const Bearing& bearing, std::int64_t utime_us) {
    return sightings_.take(bearing, utime_us, service_);
  }

 private:
  FrameService service_;
  FramePost post_;
  SightingDesk sightings_;
  std::deque<FramePart> parts_;  // of one frame
};

}  // namespace ols::station
