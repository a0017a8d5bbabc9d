#include "sim/ptu/wire.h"

#include <gtest/gtest.h>

namespace ols::sim {
namespace {

constexpr double kByte_s = 10.0 / 9600;  // start, eight bits, stop

class PtuWireTest : public testing::Test {
 protected:
  PtuWireTest() { wire_.set_baud(9600); }
  PtuWire wire_{1};
};

TEST_F(PtuWireTest, ACommandIsCompleteWhenItsDelimiterHasArrived) {
  wire_.receive("PP", 1.0);
  EXPECT_FALSE(wire_.command_s());
  wire_.receive(" TP\n", 2.0);
  EXPECT_NEAR(*wire_.command_s(), 2.0 + kByte_s, 1e-9);
  EXPECT_EQ(wire_.take_command().text, "PP");
  EXPECT_NEAR(*wire_.command_s(), 2.0 + 4 * kByte_s, 1e-9);
  const PtuWire::Command second = wire_.take_command();
  EXPECT_EQ(second.text, "TP");
  EXPECT_EQ(second.delimiter, '\n');
  EXPECT_FALSE(wire_.command_s());
}

TEST_F(PtuWireTest, BytesLeaveOneAfterAnother) {
  wire_.say("* 1\r", 1.0);
  EXPECT_EQ(wire_.transmit(1.0 + 1.5 * kByte_s), "*");
  EXPECT_NEAR(*wire_.next_output_s(), 1.0 + 2 * kByte_s, 1e-9);
  wire_.say("!", 1.0);
  EXPECT_EQ(wire_.transmit(1.0 + 4.5 * kByte_s), " 1\r") << "the next text waits for this one";
  EXPECT_EQ(wire_.transmit(2.0), "!");
  EXPECT_FALSE(wire_.next_output_s());
}

TEST_F(PtuWireTest, AnOverfullBufferStillEndsItsCommand) {
  wire_.receive(std::string(10'000, 'x') + "\n", 1.0);
  ASSERT_TRUE(wire_.command_s());
  EXPECT_EQ(wire_.take_command().text, std::string(80, 'x')) << "truncated";
}

TEST_F(PtuWireTest, AtAnotherRateEveryByteIsNoise) {
  wire_.set_master_baud(19200);
  wire_.say(std::string(64, 'A'), 1.0);
  EXPECT_NE(wire_.transmit(9.0), std::string(64, 'A'));
  wire_.set_master_baud(9600);
  wire_.say(std::string(64, 'A'), 10.0);
  EXPECT_EQ(wire_.transmit(19.0), std::string(64, 'A'));
}

TEST_F(PtuWireTest, ClearingLosesWhatIsOnTheLine) {
  wire_.receive("PP ", 1.0);
  wire_.say("* 1", 1.0);
  wire_.clear(1.0);
  EXPECT_FALSE(wire_.command_s());
  EXPECT_EQ(wire_.transmit(9.0), "");
}

}  // namespace
}  // namespace ols::sim
