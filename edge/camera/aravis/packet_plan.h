// Computes the rate at which a camera may send a frame's packets. Pure.
#pragma once

#include <cstddef>

namespace ols::camera {

struct PacketPlan {
  double delay_s = 0.0;  // from the start of a packet to the start of the next; 0 for no delay
  double bytes_per_second = 0.0;  // the stream rate that this delay gives; 0 for no limit
};

struct StreamNeed {
  std::size_t frame_bytes = 0;
  int packet_bytes = 0;            // size of an IP packet with its headers
  double frame_period_s = 0.0;     // the shortest period that can occur
  std::size_t receive_buffer = 0;  // [byte] as the kernel counts it, including its overhead
  double spread = 0.6;             // share of the frame period over which the packets are spread
};

// If the receive buffer holds three frames, the camera sends at full speed, without a delay between
// packets. A smaller buffer would overflow when the receiving thread sleeps too long. The packets
// are then spread over time, so a frame is complete later.
PacketPlan plan_packets(const StreamNeed& need);

}  // namespace ols::camera
