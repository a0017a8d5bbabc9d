#include "export/tak/cot_text.h"

#include <gmock/gmock.h>

#include "tests/unit/export/made_records.h"

namespace ols::exports {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

TEST(CotText, XmlHasTimesPointAndDetail) {
  const std::string text = cot_xml(cot_event(made_target(), {}));
  EXPECT_THAT(text, StartsWith("<?xml version=\"1.0\""));
  // Receivers of a stream cut it there; an XML declaration after anything else is an error.
  EXPECT_THAT(text, EndsWith("</event>"));
  EXPECT_THAT(text, HasSubstr("time=\"2023-11-14T22:13:20.123Z\""));
  EXPECT_THAT(text, HasSubstr("stale=\"2023-11-14T22:13:30.123Z\""));
  EXPECT_THAT(text, HasSubstr("<point lat=\"47.50000000\" lon=\"13.25000000\" hae=\"100.00\" "
                              "ce=\"3.04\" le=\"5.00\"/>"));
  EXPECT_THAT(text, HasSubstr("<track speed=\"5.00\" course=\"36.9\"/>"));
}

TEST(CotText, WhatIsUnknownHasTheFormatsOwnNumber) {
  EXPECT_THAT(cot_xml(cot_event(made_line(), {})), HasSubstr("ce=\"9999999.00\""));
}

TEST(CotText, TheHeadersOfMeshAndStream) {
  const CotEvent event = cot_event(made_target(), {});
  const std::string mesh = cot_protobuf(event, TakFraming::kMesh);
  EXPECT_EQ(mesh.substr(0, 3), "\xbf\x01\xbf");
  const std::string stream = cot_protobuf(event, TakFraming::kStream);
  const std::size_t length = mesh.size() - 3;
  ASSERT_GT(length, 127U);
  ASSERT_LT(length, 16'384U);
  EXPECT_EQ(static_cast<unsigned char>(stream[0]), 0xbfU);
  EXPECT_EQ(static_cast<unsigned char>(stream[1]), (length & 0x7fU) | 0x80U);
  EXPECT_EQ(static_cast<unsigned char>(stream[2]), length >> 7U);
  EXPECT_EQ(stream.substr(3), mesh.substr(3));
}

}  // namespace
}  // namespace ols::exports
