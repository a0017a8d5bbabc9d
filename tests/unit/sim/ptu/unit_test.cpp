#include "sim/ptu/unit.h"

#include <gtest/gtest.h>

#include "sim/ptu/answers.h"
#include "tests/unit/sim/ptu/master.h"

namespace ols::sim {
namespace {

// The simulated unit as a master sees it. The texts are those of the PTU-D46's manual and of
// transcripts of real units.

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

// The texts are those of the PTU-D46's manual and of transcripts of real units.

TEST(PtuAnswers, AnswersTersely) {
  Master master(ready_unit());
  for (const auto& [request, reply] : std::initializer_list<std::pair<const char*, const char*>>{
           {"PP ", "* 0\r\n"},
           {"pp\r", "* 0\r\n"},
           {"  PP  \r\n", "* 0\r\n"},
           {"PN PX ", "* -49467\r\n* 49467\r\n"},
           {"TN TX ", "* -14622\r\n* 9644\r\n"},
           {"PR ", "* 11.5714\r\n"},
           {"PU PL PB PA ", "* 18700\r\n* 31\r\n* 57\r\n* 2000\r\n"},
           {"PA18000 PA ", "*\r\n* 18000\r\n"},
           {"PS500 PS ", "*\r\n* 500\r\n"},
           {"C ", "* i\r\n"},
           {"PH PM ", "* REG\r\n* REG\r\n"},
           {"PHL PH PMH PM ", "*\r\n* LOW\r\n*\r\n* HIGH\r\n"},
           {"L LD L LE ",
            "* Limit bounds are ENABLED (soft limits enabled)\r\n*\r\n"
            "* Limit bounds are DISABLED (hard limits only: use care)\r\n*\r\n"},
           {"RE RD RP RT ", "*\r\n*\r\n*\r\n*\r\n"},
           {"F E ", "* ASCII terse mode\r\n* Echoing OFF\r\n"},
           {"O ", "* Input 30 VDC @ 86 degF\r\n"}}) {
    EXPECT_EQ(master.ask(request), reply) << request;
  }
}

TEST(PtuAnswers, AnswersVerbosely) {
  PtuUnitConfig config = ready_unit();
  config.verbose = true;
  Master master(config);
  EXPECT_EQ(master.ask("PP "), "* Current Pan position is 0\r\n");
  EXPECT_EQ(master.ask("TO "), "* Target Tilt position is 0\r\n");
  EXPECT_EQ(master.ask("PR "), "* 11.5714 seconds arc per position\r\n");
  EXPECT_EQ(master.ask("TX "), "* Maximum Tilt position is 9644\r\n");
  EXPECT_EQ(master.ask("PS "), "* Target Pan speed is 1000 positions/sec\r\n");
  EXPECT_EQ(master.ask("PD "), "* Current Pan speed is 0 positions/sec\r\n");
  EXPECT_EQ(master.ask("PA "), "* Pan acceleration is 2000 positions/sec/sec\r\n");
  EXPECT_EQ(master.ask("PB "), "* Current Pan base speed is 57 positions/sec\r\n");
  EXPECT_EQ(master.ask("C "), "* PTU is in independent mode\r\n");
  EXPECT_EQ(master.ask("PH "), "* Pan in REGULAR hold power mode\r\n");
  EXPECT_EQ(master.ask("FT F "), "*\r\n* ASCII terse mode\r\n");
}

TEST(PtuAnswers, RefusesAndSaysWhy) {
  Master master(ready_unit());
  EXPECT_EQ(master.ask("PP49468 "), "! Maximum allowable Pan position is 49467\r\n");
  EXPECT_EQ(master.ask("TP-14623 "), "! Minimum allowable Tilt position is -14622\r\n");
  EXPECT_EQ(master.ask("PS18701 "), "! Pan speed cannot exceed 18700 pos/sec\r\n");
  EXPECT_EQ(master.ask("PS30 "), "! Motor speed cannot be less than 31 pos/sec\r\n");
  for (const char* nonsense : {"XYZ ", "PQ ", "P ", "DX ", "PA0 ", "POSITION? ", "RX ", "LU "}) {
    const char* reply =
        nonsense[1] == 'O' ? "! Illegal argument\r\n" : "! Illegal Command Entered\r\n";
    EXPECT_EQ(master.ask(nonsense), reply) << nonsense;
  }
  for (const char* nonsense : {"POS ", "PP1x ", "PP99999999999 ", "PP1.5 ", "@(1,0,F) ", "@(x ",
                               "@(9600,0) ", "PHX ", "PNU "}) {
    EXPECT_EQ(master.ask(nonsense), "! Illegal argument\r\n") << nonsense;
  }
  EXPECT_DOUBLE_EQ(master.pan_counts(), 0.0);
}

TEST(PtuMenu, EndsAsEveryAnswerDoes) {
  Master master(ready_unit());
  const std::string menu = master.ask("? ", 2.0);
  EXPECT_NE(menu.find("PP"), std::string::npos);
  EXPECT_EQ(menu.substr(menu.size() - 5), "\r\n*\r\n");
}

}  // namespace
}  // namespace ols::sim
