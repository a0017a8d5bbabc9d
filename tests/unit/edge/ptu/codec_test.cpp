#include "edge/ptu/codec.h"

#include <gtest/gtest.h>

#include <random>

namespace ols::ptu {
namespace {

using A = PtuAxis;
using Q = PtuQuantity;

TEST(PtuRequest, WritesOneCommandAfterTheOther) {
  PtuRequest request;
  request.plain("ED").set(A::kPan, Q::kSpeed, 500).set(A::kTilt, Q::kPosition, -49467);
  request.query(A::kPan, Q::kPosition).query(A::kTilt, Q::kResolution);
  EXPECT_EQ(request.bytes(), "ED PS500 TP-49467 PP TR ");
  EXPECT_EQ(request.commands(), 5u);
  EXPECT_EQ(request.end_of(0), 3u);
  EXPECT_EQ(request.end_of(4), request.bytes().size());
  PtuRequest both;
  both.plain("H").append(request);
  EXPECT_EQ(both.bytes(), "H ED PS500 TP-49467 PP TR ");
  EXPECT_EQ(both.commands(), 6u);
  EXPECT_EQ(both.end_of(1), 5u);
}

struct ReplyCase {
  const char* name;
  const char* bytes;
  bool ok;
  bool echoed;
  const char* text;
  std::optional<double> number;
};

void PrintTo(const ReplyCase& c, std::ostream* out) { *out << c.name; }

class ValidReply : public testing::TestWithParam<ReplyCase> {};

TEST_P(ValidReply, IsUnderstoodInOnePieceAndByteByByte) {
  const ReplyCase& c = GetParam();
  for (const bool bytewise : {false, true}) {
    PtuReplyParser parser;
    std::vector<PtuReply> replies;
    const std::string bytes = c.bytes;
    for (std::size_t i = 0; i < bytes.size(); i += bytewise ? 1 : bytes.size()) {
      for (auto& reply : parser.feed(bytes.substr(i, bytewise ? 1 : bytes.size()))) {
        replies.push_back(reply);
      }
    }
    ASSERT_EQ(replies.size(), 1u);
    EXPECT_EQ(replies[0].ok, c.ok);
    EXPECT_EQ(replies[0].echoed, c.echoed);
    EXPECT_EQ(replies[0].text, c.text);
    EXPECT_EQ(replies[0].number, c.number);
    EXPECT_EQ(parser.garbled(), 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Transcripts, ValidReply,
    testing::Values(ReplyCase{"done", "*\r\n", true, false, "", {}},
                    ReplyCase{"done_cr_only", "*\r", true, false, "", {}},
                    ReplyCase{"leading_newline", "\n*\r\n", true, false, "", {}},
                    ReplyCase{"terse", "* -49467\r\n", true, false, "-49467", -49467.0},
                    ReplyCase{"terse_fraction", "\n* 23.142857\r\n", true, false, "23.142857",
                              23.142857},
                    ReplyCase{"verbose", "* Current Pan position is 0\r\n", true, false,
                              "Current Pan position is 0", 0.0},
                    ReplyCase{"verbose_unit", "* Target Pan speed is 1000 positions/sec\r\n", true,
                              false, "Target Pan speed is 1000 positions/sec", 1000.0},
                    ReplyCase{"resolution", "* 185.1428 seconds arc per position\r\n", true, false,
                              "185.1428 seconds arc per position", 185.1428},
                    ReplyCase{"echo", "PP * 100\r\n", true, true, "100", 100.0},
                    ReplyCase{"echo_on_its_own_line", "PP\r\n* 100\r\n", true, false, "100", 100.0},
                    ReplyCase{"echo_of_set", "TP-2600 *\r\n", true, true, "", {}},
                    ReplyCase{"error", "! Maximum allowable Pan position is 3090\r\n", false, false,
                              "Maximum allowable Pan position is 3090", 3090.0},
                    ReplyCase{"illegal",
                              "\n! Illegal Command Entered\r\n",
                              false,
                              false,
                              "Illegal Command Entered",
                              {}},
                    ReplyCase{"glued_tokens", "!T!T!P!P*\r\n", true, false, "", {}},
                    ReplyCase{"glued_tokens_value", "#P$T!D* 12\r\n", true, false, "12", 12.0},
                    ReplyCase{"token_behind", "* 12!P\r\n", true, false, "12", 12.0},
                    ReplyCase{"token_before_error",
                              "!P! Illegal Command Entered\r\n",
                              false,
                              false,
                              "Illegal Command Entered",
                              {}},
                    ReplyCase{"version",
                              "* Pan-Tilt Controller v2.12.1d1(C14/E), (C)2003 DP\r\n",
                              true,
                              false,
                              "Pan-Tilt Controller v2.12.1d1(C14/E), (C)2003 DP",
                              {}}),
    [](const auto& test) { return test.param.name; });

struct GarbageCase {
  const char* name;
  std::string bytes;
};

void PrintTo(const GarbageCase& c, std::ostream* out) { *out << c.name; }

class Garbage : public testing::TestWithParam<GarbageCase> {};

TEST_P(Garbage, IsCountedAndTheNextReplyIsUnderstood) {
  PtuReplyParser parser;
  EXPECT_TRUE(parser.feed(GetParam().bytes + "\r\n").empty());
  EXPECT_EQ(parser.garbled(), 1u);
  const auto replies = parser.feed("* 5\r\n");
  ASSERT_EQ(replies.size(), 1u);
  EXPECT_EQ(replies[0].number, 5.0);
}

INSTANTIATE_TEST_SUITE_P(Lines, Garbage,
                         testing::Values(GarbageCase{"control_byte", "* 1\x01 2"},
                                         GarbageCase{"high_byte", "\xff* 12"},
                                         GarbageCase{"nul", std::string("* 1\0", 4)},
                                         GarbageCase{"two_marks", "* 100* 200"},
                                         GarbageCase{"value_without_its_mark", " -4946"},
                                         GarbageCase{"overlong", "* " + std::string(5000, '7')},
                                         GarbageCase{"overlong_echo", std::string(200, 'A') + "*"}),
                         [](const auto& test) { return test.param.name; });

TEST(PtuReplyParser, CountsOnlyLimitHits) {
  PtuReplyParser parser;
  parser.feed("!T!T*\r\n!P* 1\r\n#P$P!D*\r\n! Motor speed cannot be less than 31 pos/sec\r\n");
  EXPECT_EQ(parser.limit_hits().pan + parser.limit_hits().tilt, 3u);
}

TEST(PtuReplyParser, AnswersSeveralCommandsInOrder) {
  PtuReplyParser parser;
  const auto replies = parser.feed("PP * 100\r\nTP\r\n* 600\r\nED *\r\n*\r\n");
  ASSERT_EQ(replies.size(), 4u);
  EXPECT_EQ(replies[0].count(), 100);
  EXPECT_EQ(replies[1].count(), 600);
  EXPECT_FALSE(replies[3].echoed);
}

TEST(PtuReply, CountIsWholeAndOf32Bits) {
  PtuReplyParser parser;
  const auto count = [&parser](const std::string& text) {
    return parser.feed("* " + text + "\r\n").at(0).count();
  };
  EXPECT_EQ(count("2147483647"), 2147483647);
  EXPECT_EQ(count("-2147483648"), -2147483647 - 1);
  EXPECT_EQ(count("+7"), 7);
  EXPECT_FALSE(count("2147483648"));
  EXPECT_FALSE(count("1.5"));
  EXPECT_FALSE(count("nan"));
  EXPECT_FALSE(count("inf"));
  EXPECT_FALSE(count("1e3"));
  EXPECT_FALSE(count("12a"));
  EXPECT_FALSE(count("--5"));
}

// The mark's byte is the fourth from the end; it was complete three byte times before the last.
TEST(PtuReplyParser, SaysWhenAReplyBegan) {
  PtuReplyParser parser;
  const auto first = parser.feed("* 5\r\n", 10.0, 0.001);
  ASSERT_EQ(first.size(), 1u);
  EXPECT_DOUBLE_EQ(first[0].began_s, 10.0 - 4 * 0.001);
  EXPECT_TRUE(parser.feed("!T*", 20.0, 0.001).empty());
  const auto second = parser.feed("\r\n", 21.0, 0.001);
  ASSERT_EQ(second.size(), 1u);
  EXPECT_DOUBLE_EQ(second[0].began_s, 20.0);
}

// Whatever comes, and however it is cut: no reply is longer than a line, and after a line's end a
// good reply is understood. Half of the bytes are of the protocol's own alphabet.
TEST(PtuReplyParser, SurvivesRandomBytes) {
  std::mt19937 random(20240607);
  const std::string alphabet = "**!! PTPD#$0123456789-+.\r\n\rED";
  std::uniform_int_distribution<int> any(0, 255), coin(0, 1), length(0, 40);
  std::uniform_int_distribution<std::size_t> letter(0, alphabet.size() - 1);
  PtuReplyParser parser;
  for (int round = 0; round < 20000; ++round) {
    std::string bytes;
    for (int i = length(random); i > 0; --i) {
      bytes.push_back(coin(random) != 0 ? alphabet[letter(random)]
                                        : static_cast<char>(any(random)));
    }
    for (const PtuReply& reply : parser.feed(bytes)) {
      ASSERT_LE(reply.text.size(), 256u);
      ASSERT_EQ(reply.text.find_first_of("\r\n*"), std::string::npos);
    }
    if (round % 10 == 0) {
      parser.feed("\r\n");
      const auto replies = parser.feed("* -49467\r\n");
      ASSERT_EQ(replies.size(), 1u);
      ASSERT_EQ(replies[0].count(), -49467);
    }
  }
  EXPECT_GT(parser.garbled(), 1000u);
}

TEST(PtuReplyParser, CutsDoNotMatter) {
  std::mt19937 random(5);
  const std::string alphabet = "*! PT#D$079-\r\nA";
  std::uniform_int_distribution<std::size_t> letter(0, alphabet.size() - 1);
  std::uniform_int_distribution<std::size_t> piece(1, 9);
  std::string bytes;
  for (int i = 0; i < 20000; ++i) bytes.push_back(alphabet[letter(random)]);
  PtuReplyParser whole, cut;
  const auto expected = whole.feed(bytes);
  std::vector<PtuReply> got;
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t size = piece(random);
    for (auto& reply : cut.feed(std::string_view(bytes).substr(at, size))) got.push_back(reply);
    at += size;
  }
  ASSERT_GT(expected.size(), 300u);
  ASSERT_EQ(got.size(), expected.size());
  for (std::size_t i = 0; i < got.size(); ++i) EXPECT_EQ(got[i].text, expected[i].text);
  EXPECT_EQ(cut.garbled(), whole.garbled());
  EXPECT_EQ(cut.limit_hits().pan, whole.limit_hits().pan);
  EXPECT_EQ(cut.limit_hits().tilt, whole.limit_hits().tilt);
}

}  // namespace
}  // namespace ols::ptu
