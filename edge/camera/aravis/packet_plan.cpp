#include "edge/camera/aravis/packet_plan.h"

namespace ols::camera {
namespace {

constexpr std::size_t kHeaders = 20 + 8 + 8;  // [byte] IP, UDP and GVSP of each packet
// With packets of 1500 the kernel counts up to about twice a frame's bytes, and a second frame may
// arrive before the first is read.
constexpr std::size_t kBufferedFrames = 3;

}  // namespace

PacketPlan plan_packets(const StreamNeed& need) {
  if (need.receive_buffer >= kBufferedFrames * need.frame_bytes) return {};
  const auto payload = static_cast<std::size_t>(need.packet_bytes) - kHeaders;
  const std::size_t packets = (need.frame_bytes + payload - 1) / payload + 2;  // leader, trailer
  const double delay_s = need.spread * need.frame_period_s / static_cast<double>(packets);
  return {.delay_s = delay_s, .bytes_per_second = need.packet_bytes / delay_s};
}

}  // namespace ols::camera
