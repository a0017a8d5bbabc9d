#include "edge/station/station_mode.h"

#include <gtest/gtest.h>

namespace ols::station {
namespace {

TEST(StationMode, CountsEntriesAndSecondsOfEachState) {
  StationMode mode;
  EXPECT_FALSE(mode.enter(StationState::kIdle)) << "it is idle already";
  EXPECT_TRUE(mode.enter(StationState::kManual));
  mode.count_seconds(1.5);
  EXPECT_EQ(mode.counters().at("entered_manual"), 1.0);
  EXPECT_EQ(mode.counters().at("seconds_manual"), 1.5);
  EXPECT_EQ(mode.counters().at("seconds_emergency"), 0.0) << "told before it was entered";
}

TEST(StationMode, NobodyTracksWhileTheOperatorOrAStopHasTheUnit) {
  StationMode mode;
  for (const StationState state : {StationState::kManual, StationState::kStopped,
                                   StationState::kEmergency, StationState::kIdle}) {
    mode.enter(state);
    EXPECT_FALSE(mode.may_track()) << to_string(state);
  }
  for (const StationState state : {StationState::kTracking, StationState::kCoasting,
                                   StationState::kLost, StationState::kSlewed}) {
    mode.enter(state);
    EXPECT_TRUE(mode.may_track()) << to_string(state);
  }
}

TEST(StationMode, AStopHoldsForAMomentAndAnEmergencyForGood) {
  StationMode mode;
  mode.enter(StationState::kStopped);
  EXPECT_EQ(mode.refuses_operator(10.0), Refusal::kNone) << "stopped by a restart, not just now";
  mode.note_stop(10.0);
  EXPECT_EQ(mode.refuses_operator(10.0 + StationMode::kStopHold_s - 0.01), Refusal::kJustStopped);
  EXPECT_EQ(mode.refuses_operator(10.0 + StationMode::kStopHold_s), Refusal::kNone);
  mode.enter(StationState::kEmergency);
  EXPECT_EQ(mode.refuses_operator(1e6), Refusal::kEmergency);
}

TEST(StationMode, AUnitThatIsNotThereHasNoDoubtfulAngles) {
  StationMode mode;
  EXPECT_FALSE(mode.has_doubtful_angles());
  for (const mount::Reference doubtful : {mount::Reference::kMissing, mount::Reference::kDoubted}) {
    mode.set_reference(doubtful);
    EXPECT_TRUE(mode.has_doubtful_angles());
  }
  mode.set_reference(mount::Reference::kTrusted);
  EXPECT_FALSE(mode.has_doubtful_angles());
}

}  // namespace
}  // namespace ols::station
