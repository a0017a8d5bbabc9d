#include "edge/camera/ptp.h"

#include <gtest/gtest.h>

namespace ols::camera {
namespace {

TEST(PtpState, TheWordsOfDifferentFirmware) {
  EXPECT_EQ(ptp_state("Slave"), PtpState::kSlave);
  for (const char* word : {"Syncing", "Uncalibrated", "Listening", "Initializing"})
    EXPECT_EQ(ptp_state(word), PtpState::kSyncing) << word;
  EXPECT_EQ(ptp_state("Master"), PtpState::kMaster);
  EXPECT_EQ(ptp_state("Disabled"), PtpState::kOff);
  EXPECT_EQ(ptp_state("Off"), PtpState::kOff);
  EXPECT_EQ(ptp_state("Faulty"), PtpState::kFault);
  EXPECT_EQ(ptp_state("Dreaming"), PtpState::kUnknown);
}

}  // namespace
}  // namespace ols::camera
