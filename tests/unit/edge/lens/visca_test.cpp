#include "edge/lens/visca.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace ols::lens::visca {
namespace {

std::string hex(const std::string& bytes) {
  std::string text;
  for (const unsigned char byte : bytes) {
    char two[4];
    std::snprintf(two, sizeof two, "%02x ", byte);
    text += two;
  }
  return text.substr(0, text.empty() ? 0 : text.size() - 1);
}

std::string raw(std::initializer_list<int> values) {
  std::string text;
  for (const int value : values) text += static_cast<char>(value);
  return text;
}

// By the command lists that docs/overview.md names.
TEST(Visca, CommandsAreThoseOfTheManuals) {
  EXPECT_EQ(hex(clear_interface()), "81 01 00 01 ff");
  EXPECT_EQ(hex(ask_version()), "81 09 00 02 ff");
  EXPECT_EQ(hex(focus_by_hand()), "81 01 04 38 03 ff");
  EXPECT_EQ(hex(exposure_by_hand()), "81 01 04 39 03 ff");
  EXPECT_EQ(hex(ask_position(Axis::kZoom)), "81 09 04 47 ff");
  EXPECT_EQ(hex(ask_position(Axis::kFocus)), "81 09 04 48 ff");
  EXPECT_EQ(hex(ask_position(Axis::kIris)), "81 09 04 4b ff");
  EXPECT_EQ(hex(go_to(Axis::kZoom, 0.5)), "81 01 04 47 02 00 00 00 ff");
  EXPECT_EQ(hex(go_to(Axis::kZoom, 7.0)), "81 01 04 47 04 00 00 00 ff") << "no digital zoom";
  EXPECT_EQ(hex(go_to(Axis::kFocus, 0.0)), "81 01 04 48 01 00 00 00 ff");
  EXPECT_EQ(hex(go_to(Axis::kFocus, 1.0)), "81 01 04 48 0f 00 00 00 ff");
  EXPECT_EQ(hex(go_to(Axis::kIris, 1.0)), "81 01 04 4b 00 00 01 01 ff");
  EXPECT_EQ(hex(go_on(Axis::kZoom, 1.0)), "81 01 04 07 27 ff") << "tele";
  EXPECT_EQ(hex(go_on(Axis::kZoom, -0.05)), "81 01 04 07 30 ff") << "wide";
  EXPECT_EQ(hex(go_on(Axis::kFocus, 1.0)), "81 01 04 08 37 ff") << "near";
  EXPECT_EQ(hex(go_on(Axis::kFocus, -1.0)), "81 01 04 08 27 ff") << "far";
  EXPECT_EQ(hex(go_on(Axis::kIris, 0.3)), "81 01 04 0b 02 ff");
  EXPECT_EQ(hex(stand(Axis::kZoom)), "81 01 04 07 00 ff");
  EXPECT_EQ(hex(stand(Axis::kFocus)), "81 01 04 08 00 ff");
  EXPECT_EQ(stand(Axis::kIris), "");
}

TEST(Visca, RepliesAreToldApart) {
  EXPECT_EQ(reply(raw({0x90, 0x41, 0xff}))->kind, ReplyKind::kAcknowledged);
  EXPECT_EQ(reply(raw({0x90, 0x52, 0xff}))->kind, ReplyKind::kCompleted);
  const auto error = reply(raw({0x90, 0x61, 0x41, 0xff}));
  EXPECT_EQ(error->kind, ReplyKind::kError);
  EXPECT_EQ(error->text, "not executable now");
  const auto value = reply(raw({0x90, 0x50, 0x02, 0x00, 0x00, 0x00, 0xff}));
  EXPECT_EQ(value->kind, ReplyKind::kValue);
  EXPECT_EQ(position_in(Axis::kZoom, value->data), 0.5);
  for (const auto& other : {raw({0xff}), raw({0xa0, 0x41, 0xff}), raw({0x90, 0x41, 0x41}),
                            raw({0x90, 0x31, 0xff}), raw({0x90, 0x60, 0xff})}) {
    EXPECT_FALSE(reply(other)) << hex(other);
  }
}

TEST(Visca, ValuesOfAnotherFormAreNone) {
  EXPECT_FALSE(position_in(Axis::kZoom, raw({0, 0, 0})));
  EXPECT_FALSE(position_in(Axis::kZoom, raw({0, 0x10, 0, 0})));
  EXPECT_EQ(position_in(Axis::kFocus, raw({0x0f, 0, 0, 0})), 1.0);
  EXPECT_EQ(position_in(Axis::kIris, raw({0, 0, 1, 1})), 1.0);
  EXPECT_EQ(version_in(raw({0, 0x20, 4, 0x66, 1, 5, 2})), "vendor 0020, model 0466, ROM 0105");
  EXPECT_FALSE(version_in(raw({0, 0x20})));
}

TEST(Visca, PacketsDoNotDependOnHowTheirBytesAreSplit) {
  Packets packets;
  EXPECT_TRUE(packets.receive(raw({0x90, 0x41})).empty());
  const auto two = packets.receive(raw({0xff, 0x90, 0x51, 0xff, 0x90}));
  ASSERT_EQ(two.size(), 2U);
  EXPECT_EQ(hex(two[0]), "90 41 ff");
  static_cast<void>(packets.receive(std::string(40, 'x')));
  EXPECT_EQ(packets.garbled(), 2U);
}

}  // namespace
}  // namespace ols::lens::visca
