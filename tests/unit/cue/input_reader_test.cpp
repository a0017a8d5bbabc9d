#include "cue/input_reader.h"

#include <gtest/gtest.h>

namespace ols::cues {
namespace {

constexpr const char* kLine =
    R"({"id": "a", "latitude_deg": 1, "longitude_deg": 2, "height_m": 3})";

TEST(InputReader, ReadsAStreamInPiecesAndADatagramWhole) {
  InputReader stream(Format::kJson, {}, true);
  const std::string line = std::string(kLine) + "\n";
  EXPECT_TRUE(stream.take(line.substr(0, 20), 1).empty());
  EXPECT_EQ(stream.take(line.substr(20) + line, 1).size(), 2U);
  InputReader datagrams(Format::kJson, {}, false);
  EXPECT_TRUE(std::holds_alternative<Report>(datagrams.take(kLine, 1).at(0)));
}

TEST(InputReader, GivesEachFormatToItsOwnReader) {
  const auto malformed = [](Format format, bool is_stream) {
    InputReader reader(format, {"a-"}, is_stream);
    return std::get<Refused>(reader.take("rubbish</event>\n", 1).at(0)).what;
  };
  EXPECT_EQ(malformed(Format::kCot, true), "no event");
  EXPECT_EQ(malformed(Format::kSbs, true), "no line of SBS");
  EXPECT_EQ(malformed(Format::kAircraftJson, false), "is no aircraft.json");
  EXPECT_EQ(malformed(Format::kJson, true), "no JSON object");
  EXPECT_EQ(malformed(Format::kSapient, false), "no SAPIENT");
}

TEST(InputReader, AStreamWithoutAnEndIsRefusedOnce) {
  InputReader reader(Format::kSbs, {}, true);
  const Readings found = reader.take(std::string(70'000, 'x'), 1);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(std::get<Refused>(found[0]).why, Refusal::kMalformed);
  EXPECT_TRUE(reader.take("x", 1).empty());
  reader.clear();
  EXPECT_EQ(reader.take("MSG,3,1,1,3C6444,1,,,,,,10000,,,49.2,16.6,,,0,0,0,0\n", 1).size(), 1U);
}

}  // namespace
}  // namespace ols::cues
