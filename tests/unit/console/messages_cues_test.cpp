#include "console/messages_cues.h"

#include <gtest/gtest.h>

#include "ols_msg/fusion_status_t.hpp"
#include "tests/unit/on_the_bus.h"
#include "wire/fusion_status.h"

namespace ols::console {
namespace {

TEST(MessagesCues, AreWhatTheFusionSays) {
  using M = ols_msg::fusion_status_t;
  auto status = made<M>();
  status.cues = 2;
  status.cue_id = {"adsb.3c6444", "tak.\x1b[2J"};
  status.cue_label = {"DLH9LF", ""};
  status.cue_state = {M::CUE_FOUND, M::CUE_WAITING};
  status.cue_target_id = {7, 0};
  status.cue_age_s = {0.54, 1.0};
  status.cue_latitude_deg = {49.2, std::nan("")};
  status.cue_longitude_deg = {16.6, 16.7};
  status.cue_height_m = {400.04, 1.0};
  status.cue_horizontal_sd_m = {5.0, 6.0};
  status.cue_vertical_sd_m = {9.0, 6.0};
  const Json cues = cues_of(*wire::decode_fusion_status(on("OLS_FUSION_STATUS", status)));
  ASSERT_EQ(cues.size(), 2U);
  EXPECT_EQ(cues[0]["id"], "adsb.3c6444");
  EXPECT_EQ(cues[0]["label"], "DLH9LF");
  EXPECT_EQ(cues[0]["state"], "found");
  EXPECT_EQ(cues[0]["target"], "7");
  EXPECT_EQ(cues[0]["age_s"], 0.5);
  EXPECT_EQ(cues[0]["height_m"], 400.0);
  EXPECT_EQ(cues[0]["vertical_sd_m"], 9.0);
  EXPECT_EQ(cues[1]["state"], "waiting");
  EXPECT_EQ(cues[1]["target"], "");
  EXPECT_TRUE(cues[1]["latitude_deg"].is_null());
  EXPECT_EQ(cues[1]["id"].get<std::string>().find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace ols::console
