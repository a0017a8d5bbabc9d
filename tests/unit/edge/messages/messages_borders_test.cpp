#include "edge/messages/messages_borders.h"

#include <gtest/gtest.h>

#include <vector>

namespace ols::station {
namespace {

using Status = ols_msg::station_status_t;

TEST(MessagesBorders, SixteenPointsOfEachInTheirOrder) {
  Border travel, keep_out;
  keep_out.is_keep_out = true;
  keep_out.outline[3] = {1.25, -0.5};
  Status status{};
  fill_borders({travel, keep_out}, status);
  ASSERT_EQ(status.borders, 2);
  EXPECT_EQ(status.border_kind[0], +Status::BORDER_TRAVEL);
  EXPECT_EQ(status.border_kind[1], +Status::BORDER_KEEP_OUT);
  ASSERT_EQ(status.border_points, 2 * kBorderPoints);
  EXPECT_EQ(status.border_azimuth_rad[kBorderPoints + 3], 1.25);
  EXPECT_EQ(status.border_elevation_rad[kBorderPoints + 3], -0.5);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(status.getEncodedSize()));
  const int size = static_cast<int>(bytes.size());
  EXPECT_EQ(status.encode(bytes.data(), 0, size), size);
}

}  // namespace
}  // namespace ols::station
