#include "sim/camera/gige_wire.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace ols::sim::gige {
namespace {

using testing::ElementsAre;

TEST(GigeWire, ParsesACommand) {
  const std::vector<std::uint8_t> packet{0x42, 0x01, 0x00, 0x80, 0x00, 0x04,
                                         0xab, 0xcd, 0x00, 0x00, 0x09, 0x3c};
  const auto command = parse(packet);
  ASSERT_TRUE(command);
  EXPECT_EQ(command->command, Command::kReadRegister);
  EXPECT_EQ(command->id, 0xabcd);
  EXPECT_EQ(big_endian(command->data), 0x093cU);
}

TEST(GigeWire, RefusesWhatIsNoCommand) {
  EXPECT_FALSE(parse({}));
  EXPECT_FALSE(parse(std::vector<std::uint8_t>{0x42, 0x01, 0x00, 0x80}));              // short
  EXPECT_FALSE(parse(std::vector<std::uint8_t>{0x00, 0, 0, 0x80, 0, 0, 0, 1}));        // no key
  EXPECT_FALSE(parse(std::vector<std::uint8_t>{0x42, 1, 0, 0x80, 0, 4, 0, 1, 0, 0}));  // cut off
}

TEST(GigeWire, AcknowledgesWithTheNextCommandAndTheSameId) {
  const ControlPacket asked{.command = Command::kReadRegister, .id = 0x1234, .data = {}};
  EXPECT_THAT(acknowledge(asked, Status::kSuccess, big_endian(0xdeadbeefU)),
              ElementsAre(0, 0, 0x00, 0x81, 0, 4, 0x12, 0x34, 0xde, 0xad, 0xbe, 0xef));
  EXPECT_THAT(acknowledge(asked, Status::kAccessDenied, {}),
              ElementsAre(0x80, 0x06, 0x00, 0x81, 0, 0, 0x12, 0x34));
}

TEST(GigeWire, StreamPackets) {
  EXPECT_THAT(stream_header(0xfffe, Content::kPayload, 0x010203),
              ElementsAre(0, 0, 0xff, 0xfe, 3, 1, 2, 3));
  const Picture picture{
      .id = 1, .stamp = 0x0102030405060708, .format = 0x01080001, .width = 1280, .height = 960};
  const auto bytes = leader(picture);
  const Bytes all(bytes);
  EXPECT_THAT(all.first(4), ElementsAre(0, 0, 0, 1));
  EXPECT_THAT(all.subspan(4, 8), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
  EXPECT_EQ(big_endian(all.subspan(12)), 0x01080001U);
  EXPECT_EQ(big_endian(all.subspan(16)), 1280U);
  EXPECT_EQ(big_endian(all.subspan(20)), 960U);
  EXPECT_THAT(trailer(picture), ElementsAre(0, 0, 0, 1, 0, 0, 3, 0xc0));
}

TEST(GigeWire, PacketsOfAPayload) {
  EXPECT_EQ(payload_packets(1000, 1000), 1U);
  EXPECT_EQ(payload_packets(1001, 1000), 2U);
}

}  // namespace
}  // namespace ols::sim::gige
