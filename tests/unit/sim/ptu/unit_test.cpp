// The simulated unit as a master sees it. The texts are those of the PTU-D46's manual and of
// transcripts of real units.
#include "sim/ptu/unit.h"

#include <gtest/gtest.h>

#include "tests/unit/sim/ptu/master.h"

namespace ols::sim {
namespace {

// As captured from a unit with its echo on.
TEST(PtuUnit, EchoesAsRealUnitsDo) {
  PtuUnitConfig config = ready_unit();
  config.echo = true;
  Master master(config);
  EXPECT_EQ(master.ask("PP\r\n"), "PP\r\n* 0\r\n");
  EXPECT_EQ(master.ask("PP TP\r\n"), "PP * 0\r\nTP\r\n* 0\r\n");
  EXPECT_EQ(master.ask("ED FT I CI\r\n"), "ED *\r\n*\r\n*\r\n*\r\n");
}

TEST(PtuUnit, GluesALimitHitToTheNextReply) {
  PtuUnitConfig config = ready_unit();
  config.tilt_max_counts = 100;
  Master master(config);
  EXPECT_EQ(master.ask("LD TP2000 ", 3.0), "*\r\n*\r\n!T");
  EXPECT_EQ(master.ask("TP "), "* 400\r\n");  // its mechanical stop
}

// 10 bits a byte: `PP ` takes 3 byte times in, the reply's n-th byte n more out.
TEST(PtuUnit, BytesTakeTheirTimeOnTheLine) {
  PtuUnitConfig config = ready_unit();
  config.reply_delay_s = 0.002;
  Master master(config);
  const double byte_s = 10.0 / 9600.0;
  const double begin_s = master.time_s;
  master.unit.receive("PP ", begin_s);
  const double first_s = begin_s + 3 * byte_s + 0.002 + byte_s;
  EXPECT_EQ(master.unit.transmit(first_s - 1e-6), "");
  ASSERT_TRUE(master.unit.next_output_s());
  EXPECT_EQ(master.unit.transmit(first_s + 1e-6), "*");
  EXPECT_EQ(master.unit.transmit(first_s + 4 * byte_s + 1e-6), " 0\r\n");
  EXPECT_FALSE(master.unit.next_output_s());
}

TEST(PtuUnit, AnswersABaudChangeAtTheOldRate) {
  Master master(ready_unit());
  EXPECT_EQ(master.ask("@(38400,0,F) "), "*\r\n");
  const double byte_s = 10.0 / 38400.0;
  master.unit.receive("PP ", master.time_s);
  EXPECT_EQ(master.unit.transmit(master.time_s + 0.001 + 8 * byte_s + 1e-6), "* 0\r\n");
}

TEST(PtuUnit, SurvivesRubbish) {
  Master master(ready_unit());
  std::string rubbish;
  for (int i = 0; i < 3000; ++i) rubbish.push_back(static_cast<char>(i * 37 % 256));
  master.ask(rubbish, 5.0);
  master.ask(std::string(2000, 'P'), 5.0);
  master.ask(" ", 1.0);
  EXPECT_EQ(master.ask("PX "), "* 49467\r\n");
}

TEST(PtuUnit, SameSeedSameBytes) {
  const auto talk = [](std::uint64_t seed) {
    PtuUnitConfig config = ready_unit();
    config.reply_jitter_s = 0.003;
    PtuUnit unit(config, seed, 0.0);
    std::string times;
    for (int i = 0; i < 4000; ++i) {
      if (i % 50 == 0) unit.receive("PP ", i * 1e-3);
      if (!unit.transmit(i * 1e-3).empty()) times += std::to_string(i) + " ";
    }
    return times;
  };
  EXPECT_EQ(talk(5), talk(5));
  EXPECT_NE(talk(5), talk(6));
}

}  // namespace
}  // namespace ols::sim
