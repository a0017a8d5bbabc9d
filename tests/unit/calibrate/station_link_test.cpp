#include "tools/calibrate/station_link.h"

#include <gtest/gtest.h>

#include "tests/unit/calibrate/bus_station.h"

namespace ols::calibration {
namespace {

using Command = ols_msg::ptu_command_t;
using Status = ols_msg::station_status_t;

class StationLinkTest : public testing::Test {
 protected:
  void handle() {
    while (station.bus.handle(0) > 0) {
    }
  }

  test::BusStation station;
  StationLink link{station.bus, "alfa"};
};

TEST_F(StationLinkTest, AStopIsNotReleased) {
  link.point();
  station.say(Status::STATE_MANUAL);
  handle();
  station.say(Status::STATE_STOPPED);
  EXPECT_FALSE(link.release());
  EXPECT_FALSE(link.may_point());
  handle();
  EXPECT_EQ(station.commands, std::vector<std::int8_t>{Command::COMMAND_POINT});
}

TEST_F(StationLinkTest, ItsOwnManualOperationIsReleased) {
  link.point();
  station.say(Status::STATE_MANUAL);
  EXPECT_TRUE(link.release());
  handle();
  const std::vector<std::int8_t> both{Command::COMMAND_POINT, Command::COMMAND_RELEASE};
  EXPECT_EQ(station.commands, both);
}

TEST_F(StationLinkTest, AnOperatorsManualOperationIsNotReleased) {
  station.say(Status::STATE_MANUAL);
  EXPECT_FALSE(link.release());
  link.point();
  handle();
  station.say(Status::STATE_MANUAL);
  station.say(Status::STATE_IDLE);
  station.say(Status::STATE_MANUAL);  // taken by somebody else, meanwhile
  handle();
  EXPECT_FALSE(link.release());
  handle();
  EXPECT_EQ(station.commands, std::vector<std::int8_t>{Command::COMMAND_POINT});
}

TEST_F(StationLinkTest, ARefusalIsToldUntilTheUnitIsWantedElsewhere) {
  station.refusal = "unreachable";
  link.set_out({});
  link.point();
  handle();
  EXPECT_EQ(link.refusal(), "refused: outside the travel, or in a keep-out region");
  link.set_out({0.1, 0.0});
  EXPECT_EQ(link.refusal(), "");
  station.say(Status::STATE_MANUAL);
  EXPECT_FALSE(link.release()) << "the station has refused it";
}

TEST_F(StationLinkTest, AUnitThatIsGoneMayComeBack) {
  const auto ordered = [this](const char* refusal) {
    station.refusal = refusal;
    link.point();
    handle();
  };
  link.set_out({});
  ordered("no_unit");
  EXPECT_NE(link.refusal(), "");
  EXPECT_FALSE(link.is_refused_for_good());
  ordered("no_reference");
  EXPECT_TRUE(link.is_refused_for_good()) << "its power was cut";
  ordered("unreachable");
  EXPECT_TRUE(link.is_refused_for_good());
  ordered("");
  EXPECT_FALSE(link.is_refused_for_good());
}

TEST_F(StationLinkTest, WithoutAStatusNothingMoves) { EXPECT_FALSE(link.may_point()); }

}  // namespace
}  // namespace ols::calibration
