#include "edge/camera/aravis/packet_plan.h"

#include <gtest/gtest.h>

namespace ols::camera {
namespace {

constexpr std::size_t kFrame = 1280 * 960;
constexpr std::size_t kStockBuffer = 2 * 212992;  // what the kernel grants and counts

StreamNeed need(std::size_t buffer, int packet_bytes) {
  return {.frame_bytes = kFrame,
          .packet_bytes = packet_bytes,
          .frame_period_s = 1.0 / 15.0,
          .receive_buffer = buffer,
          .spread = 0.6};
}

TEST(PacketPlan, ALargeBufferTakesFramesAsFastAsTheyCome) {
  const PacketPlan plan = plan_packets(need(16U << 20, 1500));
  EXPECT_DOUBLE_EQ(plan.delay_s, 0.0);
  EXPECT_DOUBLE_EQ(plan.bytes_per_second, 0.0);
}

TEST(PacketPlan, AStockBufferGetsTheFrameSpreadOverItsPeriod) {
  for (const int packet_bytes : {1500, 9000, 65000}) {
    const PacketPlan plan = plan_packets(need(kStockBuffer, packet_bytes));
    const double packets = static_cast<double>(kFrame) / (packet_bytes - 36);
    EXPECT_NEAR(plan.delay_s * packets, 0.6 / 15.0, 0.005) << packet_bytes;
    EXPECT_NEAR(plan.bytes_per_second * plan.delay_s, packet_bytes, 1e-6);
    // What comes while the receiver sleeps for 5 ms still fits.
    EXPECT_LT(plan.bytes_per_second * 5e-3, kStockBuffer / 2);
  }
}

}  // namespace
}  // namespace ols::camera
