#include "edge/frames/frame_desk.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ols::station {

void FrameDesk::look(const clock::ClockPair& now, const PointingModel& unit) {
  for (RequestedFrame& frame : service_.take(now.monotonic_s, unit)) post_.put(std::move(frame));
  // One at a time: what is asked for faster than it can be sent waits in the post, which is
  // bounded.
  if (!parts_.empty()) return;
  auto encoded = post_.take();
  if (!encoded) return;
  const auto frame = std::make_shared<const EncodedFrame>(std::move(*encoded));
  const double age_s = now.monotonic_s - frame->frame.frame.mid_exposure_s;
  const std::int64_t utime_us = now.utime_us - std::llround(age_s * 1e6);
  const std::size_t size = frame->file.size();
  const std::size_t parts = (size + kPart_bytes - 1) / kPart_bytes;
  for (std::size_t i = 0; i < parts; ++i) {
    const std::size_t first = i * kPart_bytes;
    parts_.push_back({frame, utime_us, i, parts, first, std::min(kPart_bytes, size - first)});
  }
}

std::optional<FramePart> FrameDesk::next() {
  if (parts_.empty()) return std::nullopt;
  FramePart part = std::move(parts_.front());
  parts_.pop_front();
  return part;
}

}  // namespace ols::station
