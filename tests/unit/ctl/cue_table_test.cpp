#include "tools/ctl/cue_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ols::ctl {
namespace {

using testing::HasSubstr;

TEST(CueTable, HasARowForEachCue) {
  using M = ols_msg::fusion_status_t;
  M status{};
  status.cue_id = {"tak.a", "adsb.3c6444"};
  status.cue_label = {"Anna", ""};
  status.cue_state = {M::CUE_WAITING, M::CUE_FOUND};
  status.cue_target_id = {0, 7};
  status.cue_age_s = {1.25, 0.5};
  status.cue_latitude_deg = {49.2, 49.3};
  status.cue_longitude_deg = {16.6, 16.7};
  status.cue_height_m = {400.0, 900.0};
  status.cue_horizontal_sd_m = {5.0, 3.0};
  status.cue_vertical_sd_m = {9.0, 4.0};
  const std::string table = cue_table(status, {{7, "drone (92 %)"}});
  EXPECT_THAT(
      table,
      HasSubstr("tak.a                waiting         -  -                 1.2      49.200000"));
  EXPECT_THAT(table, HasSubstr("Anna\n"));
  EXPECT_THAT(
      table,
      HasSubstr("adsb.3c6444          found           7  drone (92 %)      0.5      49.300000"));
}

TEST(CueTable, SaysThatThereAreNone) { EXPECT_EQ(cue_table({}, {}), "no cues\n"); }

}  // namespace
}  // namespace ols::ctl
