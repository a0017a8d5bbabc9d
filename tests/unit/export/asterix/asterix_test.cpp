#include <gtest/gtest.h>

#include <string>

#include "export/asterix/asterix_encoder.h"
#include "export/asterix/asterix_record.h"
#include "export/asterix/categories.h"
#include "export/asterix/track_numbers.h"
#include "tests/unit/export/made_records.h"

namespace ols::exports {
namespace {

int category(const Packets& packets) { return static_cast<unsigned char>(packets.at(0).bytes[0]); }

TEST(AsterixEncoder, EachKindHasItsCategory) {
  AsterixEncoder encoder({.sac = 25, .sic = 10, .stations = {"alfa"}});
  EXPECT_EQ(category(encoder.encode(made_target())), 62);
  EXPECT_EQ(category(encoder.encode(made_station())), 63);
  EXPECT_EQ(category(encoder.due(kNow_us)), 65);
  EXPECT_EQ(category(encoder.encode(made_line())), 15);
}

TEST(AsterixEncoder, AStationWithoutACodeIsNotSent) {
  AsterixEncoder encoder({});
  EXPECT_TRUE(encoder.encode(made_station()).empty());
  EXPECT_TRUE(encoder.encode(made_line()).empty());
}

TEST(AsterixEncoder, AnEndFreesTheNumber) {
  AsterixEncoder encoder({});
  Target end = made_target();
  const std::string first = encoder.encode(end)[0].bytes;
  end.state = TrackState::kEnded;
  encoder.encode(end);
  Target other = made_target();
  other.uid = "another";
  EXPECT_EQ(encoder.encode(other)[0].bytes, first);
}

std::string bytes(std::initializer_list<int> values) {
  std::string text;
  for (const int value : values) text += static_cast<char>(value);
  return text;
}

TEST(AsterixRecord, ItsItemsStandInTheFieldSpecification) {
  EXPECT_EQ(AsterixRecord().with(1, "a").with(7, "b").bytes(), bytes({0x82}) + "ab");
  EXPECT_EQ(AsterixRecord().with(8, "c").with(2, "d").bytes(), bytes({0x41, 0x80}) + "dc");
  EXPECT_EQ(AsterixRecord().with(20, "e").bytes(), bytes({0x01, 0x01, 0x04}) + "e");
}

TEST(AsterixRecord, NumbersAreScaledAndStayInTheirRange) {
  EXPECT_EQ(asterix_unsigned(10.2, 0.5, 2), bytes({0x00, 0x14}));
  EXPECT_EQ(asterix_unsigned(1e9, 0.5, 1), bytes({0xff}));
  EXPECT_EQ(asterix_unsigned(-1.0, 0.5, 1), bytes({0x00}));
  EXPECT_EQ(asterix_signed(-1.0, 0.25, 2), bytes({0xff, 0xfc}));
  EXPECT_EQ(asterix_signed(-1e9, 0.25, 2), bytes({0x80, 0x00}));
  EXPECT_EQ(asterix_signed(1e9, 0.25, 2), bytes({0x7f, 0xff}));
}

TEST(AsterixRecord, TimeCountsFromMidnight) {
  EXPECT_EQ(asterix_time(86'400'000'000LL * 3), bytes({0, 0, 0}));
  EXPECT_EQ(asterix_time(86'400'000'000LL * 3 + 2'500'000), bytes({0, 0x01, 0x40}));
}

TEST(AsterixRecord, ACompoundBeginsWithWhatIsThere) {
  EXPECT_EQ(asterix_compound({{0, "x"}, {2, "y"}}), bytes({0xa0}) + "xy");
  EXPECT_EQ(asterix_block(62, {"ab", "c"}), bytes({62, 0, 6}) + "abc");
}

// tests/e2e/test_export_asterix.py has others' decoders read every field; here is what they depend
// on.
std::string hex(const std::string& bytes) {
  std::string text;
  for (const char c : bytes) {
    text += "0123456789abcdef"[static_cast<unsigned char>(c) >> 4U];
    text += "0123456789abcdef"[static_cast<unsigned char>(c) & 0xfU];
  }
  return text;
}

const AsterixSettings kSettings{.sac = 25, .sic = 10, .stations = {"alfa"}};

TEST(AsterixCategories, ASystemTrack) {
  // 47.5 and 13.25 degrees are 8854642 and 2469979 units; 22:13:20.123 are 10240015 / 128 s.
  EXPECT_EQ(hex(cat062(made_target(), 7, kSettings)),
            "3e0029"
            "9b0d1504"
            "190a"
            "9c400f"
            "00871c72"
            "0025b05b"
            "000c0010"
            "0007"
            "2c"
            "0034"
            "ffd1"
            "d4"
            "00040006"
            "0002"
            "03"
            "0202");
}

TEST(AsterixCategories, AccuraciesAreNeverBetterThanTheyAre) {
  Target target = made_target();
  target.covariance_m2 = {0.0025, 0.0, 0.0, 0.36, 0.0, 1e-8};
  target.velocity_covariance_m2_s2 = {1e-4, 0.0, 0.0, 0.0676, 0.0, 0.0};
  const std::string bytes = hex(cat062(target, 7, kSettings));
  // 0.05 and 0.6 m in units of 0.5 m, no covariance, a height's in 1.9 m, 0.01 and 0.26 m/s in
  // 0.25.
  EXPECT_EQ(bytes.substr(bytes.size() - 18),
            "00010002"
            "0000"
            "01"
            "0102");
}

TEST(AsterixCategories, ADroneIsAnUnmannedEmitter) {
  Target target = made_target();
  target.object_class = ObjectClass::kBird;
  EXPECT_EQ(hex(cat062(target, 7, kSettings)), hex(cat062(made_target(), 7, kSettings)));
  target.object_class = ObjectClass::kDrone;
  const std::string record = hex(cat062(target, 7, kSettings));
  EXPECT_EQ(record.substr(6, 8), "9b1d1504");  // I062/380 is the eleventh item
  EXPECT_EQ(record.substr(2 * (3 + 4 + 2 + 3 + 8 + 4), 8), "0101020d");
}

TEST(AsterixCategories, StatesOfATrack) {
  Target target = made_target();
  const auto status = [&target](TrackState state) {
    target.state = state;
    return hex(cat062(target, 7, kSettings)).substr(2 * (3 + 4 + 2 + 3 + 8 + 4 + 2), 8);
  };
  EXPECT_EQ(status(TrackState::kTentative).substr(0, 2), "2e");
  EXPECT_EQ(status(TrackState::kEnded).substr(0, 4), "2d40");
  EXPECT_EQ(status(TrackState::kCoasted), "2d010180");
}

TEST(AsterixCategories, StatusOfSensorAndService) {
  EXPECT_EQ(hex(cat063(made_station(), 11, kSettings)), "3f000cb8190a9c400f190b00");
  Station bad = made_station();
  bad.is_well = bad.clock_is_good = false;
  EXPECT_EQ(hex(cat063(bad, 11, kSettings)), "3f000db8190a9c400f190b4108");
  EXPECT_EQ(hex(cat065(kNow_us, kSettings)), "41000bd4190a019c400f00");
}

TEST(AsterixCategories, ALineIsAMeasurementTrack) {
  EXPECT_EQ(hex(cat015(made_line(), 11, kSettings)),
            "0f001b"
            "d78101c0"
            "190b"
            "05"
            "00"
            "9c400f"
            "0003"
            "00"
            "a04000000f"
            "a002d8001e");
}

TEST(TrackNumbers, AreTheFusionsUnlessTheyAreTaken) {
  TrackNumbers numbers;
  EXPECT_EQ(numbers.of("a", 7), 7);
  EXPECT_EQ(numbers.of("b", 7), 8);
  EXPECT_EQ(numbers.of("a", 7), 7);
  numbers.release("a");
  EXPECT_EQ(numbers.of("c", 7 + 65'536), 7);
  EXPECT_EQ(numbers.of("d", -1), 65'535);
  EXPECT_EQ(numbers.of("e", -1), 0);
}

}  // namespace
}  // namespace ols::exports
