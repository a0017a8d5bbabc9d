// Plans the rate at which a camera may send a frame's packets. Pure.
#pragma once

#include <cstddef>

namespace ols::camera {

struct PacketPlan {
  double delay_s = 0.0;           // between the starts of two packets; 0 for no delay
  double bytes_per_second = 0.0;  // the same as a stream rate; 0 for no limit
};

struct StreamNeed {
  std::size_t frame_bytes = 0;
  int packet_bytes = 0;            // size of an IP packet
  double frame_period_s = 0.0;     // the shortest possible
  std::size_t receive_buffer = 0;  // [byte] as the kernel counts it, including its overhead
  double spread = 0.6;  // share of the frame period, used if the buffer does not hold a frame
};

// A buffer that holds whole frames receives them at full speed, without a delay between packets. A
// smaller buffer overflows when the receiving thread sleeps too long. The packets are then spread
// over time, and the frame completes later.
PacketPlan plan_packets(const StreamNeed& need);

}  // namespace ols::camera
