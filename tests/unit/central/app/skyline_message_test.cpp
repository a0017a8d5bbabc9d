#include <gtest/gtest.h>

#include <limits>

#include "central/app/messages.h"
#include "ols_msg/skyline_t.hpp"
#include "tests/unit/on_the_bus.h"

namespace ols::fusion {
namespace {

ols_msg::skyline_t skyline() {
  auto message = made<ols_msg::skyline_t>();
  message.station = "a";
  message.begun_utime = 7;
  message.camera_ecef_m[0] = 6.37e6;
  message.sector = 71;
  message.columns = 2;
  message.column = {7100, 7199};
  message.elevation_rad = {0.125F, -0.25F};
  message.sd_rad = {0.5F, 0.25F};
  message.hides_from_m = {100.0F, 0.0F};
  message.disagrees = {1, 0};
  return message;
}

auto read(const ols_msg::skyline_t& message, const std::string& channel = "OLS_SKYLINE_a") {
  const auto bytes = encoded(message);
  return skyline_sector_from(channel, bytes.data(), static_cast<int>(bytes.size()));
}

TEST(SkylineMessage, IsRead) {
  const auto decoded = read(skyline());
  ASSERT_TRUE(std::holds_alternative<SkylineSector>(decoded));
  const auto& sector = std::get<SkylineSector>(decoded);
  EXPECT_EQ(sector.station, "a");
  EXPECT_EQ(sector.begun_us, 7);
  EXPECT_EQ(sector.camera_ecef.x(), 6.37e6);
  EXPECT_FALSE(sector.heading_disagrees);
  EXPECT_EQ(sector.sector, 71);
  ASSERT_EQ(sector.columns.size(), 2U);
  EXPECT_EQ(sector.columns[0].column, 7100);
  EXPECT_EQ(sector.columns[0].crest, (land::SeenCrest{0.125, 0.5, 100.0, true}));
  EXPECT_EQ(sector.columns[1].crest, (land::SeenCrest{-0.25, 0.25, 0.0, false}));
}

TEST(SkylineMessage, WhatNoStationSendsIsRefused) {
  const auto refuses = [](const auto& change) {
    auto message = skyline();
    change(message);
    const auto decoded = read(message);
    const auto* why = std::get_if<MessageRefusal>(&decoded);
    return why != nullptr && *why == MessageRefusal::kOutOfRange;
  };
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(refuses([](auto&) {}));
  EXPECT_TRUE(refuses([](auto& m) { m.sector = 72; }));
  EXPECT_TRUE(refuses([](auto& m) { m.sector = -1; }));
  EXPECT_TRUE(refuses([](auto& m) { m.column[0] = 7099; })) << "of the sector before";
  EXPECT_TRUE(refuses([](auto& m) { m.column[1] = 7200; }));
  EXPECT_TRUE(refuses([](auto& m) { m.column[1] = 7100; })) << "twice the same";
  EXPECT_TRUE(refuses([](auto& m) { m.sector = 0, m.column = {-1, 0}; }));
  EXPECT_TRUE(refuses([](auto& m) { m.elevation_rad[0] = kNan; }));
  EXPECT_TRUE(refuses([](auto& m) { m.elevation_rad[0] = 2.0F; }));
  EXPECT_TRUE(refuses([](auto& m) { m.sd_rad[0] = 0.0F; }));
  EXPECT_TRUE(refuses([](auto& m) { m.sd_rad[0] = kNan; }));
  EXPECT_TRUE(refuses([](auto& m) { m.hides_from_m[0] = -1.0F; }));
  EXPECT_TRUE(refuses([](auto& m) { m.hides_from_m[0] = kNan; }));
  EXPECT_TRUE(refuses([](auto& m) { m.camera_ecef_m[1] = kNan; }));
  EXPECT_TRUE(refuses([](auto& m) {
    m.columns = 101;
    m.column.clear();
    for (int i = 0; i < 101; ++i) m.column.push_back(static_cast<std::int16_t>(7100 + i));
    m.elevation_rad.assign(101, 0.0F);
    m.sd_rad.assign(101, 0.5F);
    m.hides_from_m.assign(101, 0.0F);
    m.disagrees.assign(101, 0);
  }));
}

TEST(SkylineMessage, AnotherStationsIsRefused) {
  EXPECT_EQ(std::get<MessageRefusal>(read(skyline(), "OLS_SKYLINE_b")),
            MessageRefusal::kOtherStation);
}

}  // namespace
}  // namespace ols::fusion
