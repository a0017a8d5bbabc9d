#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <set>
#include <string>
#include <vector>

#include "central/app/messages.h"
#include "geometry/angles.h"
#include "ols_msg/fusion_status_t.hpp"
#include "tests/unit/on_the_bus.h"

namespace ols::fusion {
namespace {

TEST(StatusMessage, TheFusionsStatusNamesWhoIsQuarantined) {
  FusionHealth health;
  health.stations = {{"a", 10, 15.0, 0.05, 1.0, 0.0, {}, {}},
                     {"b", 20, 15.0, -2.0, 1.0, 2.0, {"its stamps are ahead"}, {}}};
  health.stations[1].finding.bias_rad = {1e-3, -2e-3};
  const auto message = to_message(health, 0.1, MessageStamp{1, 2});
  ASSERT_EQ(message.stations, 2);
  EXPECT_EQ(message.quarantine, (std::vector<std::string>{"", "its stamps are ahead"}));
  EXPECT_EQ(message.clock_offset_s, (std::vector<double>{0.0, 2.0}));
  EXPECT_TRUE(std::isnan(message.bias_rad[0][0]));
  EXPECT_EQ(message.bias_rad[1], (std::vector<double>{1e-3, -2e-3}));
  EXPECT_EQ(encoded(message).size(), static_cast<std::size_t>(message.getEncodedSize()));
}

TEST(StatusMessage, TheFusionsStatusHasTheCues) {
  using M = ols_msg::fusion_status_t;
  FusionHealth health;
  health.cues = {
      {"tak.a", "Anna", CueState::kFound, 7, 1.5, {radians(49.0), radians(16.0), 400.0}, 5.0, 9.0},
      {"tak.b", "", CueState::kWaiting, 0, 2.5, {}, 1.0, 1.0},
      {"tak.c", "", CueState::kSearched, 0, 2.5, {}, 1.0, 1.0},
      {"tak.d", "", CueState::kForbidden, 0, 2.5, {}, 1.0, 1.0}};
  const auto message = to_message(health, 0.1, MessageStamp{1, 2});
  ASSERT_EQ(message.cues, 4);
  EXPECT_EQ(message.cue_id.front(), "tak.a");
  EXPECT_EQ(message.cue_label.front(), "Anna");
  EXPECT_EQ(message.cue_state, (std::vector<std::int8_t>{M::CUE_FOUND, M::CUE_WAITING,
                                                         M::CUE_SEARCHED, M::CUE_FORBIDDEN}));
  EXPECT_EQ(message.cue_target_id.front(), 7);
  EXPECT_EQ(message.cue_age_s.front(), 1.5);
  EXPECT_NEAR(message.cue_latitude_deg.front(), 49.0, 1e-9);
  EXPECT_NEAR(message.cue_longitude_deg.front(), 16.0, 1e-9);
  EXPECT_EQ(message.cue_height_m.front(), 400.0);
  EXPECT_EQ(message.cue_horizontal_sd_m.front(), 5.0);
  EXPECT_EQ(message.cue_vertical_sd_m.front(), 9.0);
  EXPECT_EQ(encoded(message).size(), static_cast<std::size_t>(message.getEncodedSize()));
}

TEST(StatusMessage, AThousandStationsAreToldInTurnsThatADatagramHolds) {
  FusionHealth health;
  for (int i = 0; i < 1001; ++i) {
    char name[8];
    std::snprintf(name, sizeof name, "s%04d", i);
    health.stations.push_back({.station = name, .quarantine = {std::string(60, 'q')}});
  }
  for (int i = 0; i < 64; ++i) {  // the most that the configuration allows
    CueHealth& cue = health.cues.emplace_back();
    cue.id = cue.label = std::string(100, 'c');
  }
  constexpr std::size_t kDatagramBytes = 65'000;
  std::set<std::string> told;
  for (std::int64_t sequence = 7; sequence < 12; ++sequence) {
    const auto message = to_message(health, 0.1, MessageStamp{1, sequence});
    EXPECT_EQ(message.stations_known, 1001);
    EXPECT_LE(encoded(message).size(), kDatagramBytes);
    told.insert(message.station.begin(), message.station.end());
  }
  EXPECT_EQ(told.size(), 1001U);
  EXPECT_EQ(to_message(FusionHealth{}, 0.1, MessageStamp{1, 2}).stations, 0);
}

}  // namespace
}  // namespace ols::fusion
