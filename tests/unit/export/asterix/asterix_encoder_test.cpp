#include "export/asterix/asterix_encoder.h"

#include <gtest/gtest.h>

#include "tests/unit/export/made_records.h"

namespace ols::exports {
namespace {

int category(const Packets& packets) { return static_cast<unsigned char>(packets.at(0).bytes[0]); }

TEST(AsterixEncoder, EachKindHasItsCategory) {
  AsterixEncoder encoder({.sac = 25, .sic = 10, .stations = {"alfa"}});
  EXPECT_EQ(category(encoder.encode(made_target())), 62);
  EXPECT_EQ(category(encoder.encode(made_station())), 63);
  EXPECT_EQ(category(encoder.turn(kNow_us)), 65);
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

}  // namespace
}  // namespace ols::exports
