// How fast a camera may send a frame's packets. Pure.
#pragma once

#include <cstddef>

namespace ols::camera {

struct PacketPlan {
  double delay_s = 0.0;           // between the starts of two packets; 0: none
  double bytes_per_second = 0.0;  // the same as a rate of the stream; 0: no limit
};

struct StreamNeed {
  std::size_t frame_bytes = 0;
  int packet_bytes = 0;            // IP packet
  double frame_period_s = 0.0;     // the shortest
  std::size_t receive_buffer = 0;  // [byte] as the kernel counts it: with what a packet costs it
  double spread = 0.6;             // of the frame period, where the buffer holds no frame
};

// A buffer that holds frames takes each as fast as it comes: none is late. A smaller one overflows
// whenever the receiving thread sleeps for longer than its share of the frame lasts, so there the
// packets are spread, at the price that the frame is complete that much later.
PacketPlan plan_packets(const StreamNeed& need);

}  // namespace ols::camera
