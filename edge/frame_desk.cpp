#include "edge/frame_desk.h"

#include <algorithm>
#include <utility>

namespace ols::station {

void FrameDesk::look(double now_s) {
  for (RequestedFrame& frame : service_.take(now_s)) post_.put(std::move(frame));
  // One at a time: what is asked for faster than it can be sent waits in the post, which is
  // bounded.
  if (!parts_.empty()) return;
  auto encoded = post_.take();
  if (!encoded) return;
  const auto frame = std::make_shared<const EncodedFrame>(std::move(*encoded));
  const std::size_t size = frame->file.size();
  const std::size_t parts = (size + kPart_bytes - 1) / kPart_bytes;
  for (std::size_t i = 0; i < parts; ++i) {
    const std::size_t first = i * kPart_bytes;
    parts_.push_back({frame, i, parts, first, std::min(kPart_bytes, size - first)});
  }
}

std::optional<FramePart> FrameDesk::next() {
  if (parts_.empty()) return std::nullopt;
  FramePart part = std::move(parts_.front());
  parts_.pop_front();
  return part;
}

}  // namespace ols::station
