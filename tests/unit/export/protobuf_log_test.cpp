#include "export/protobuf_log.h"

#include <gtest/gtest.h>

#include <string>

#include "sapient/sapient.pb.h"

namespace ols::exports {
namespace {

// A SapientMessage whose node_id (field 2) is no UTF-8.
const std::string kDamaged("\x12\x02\xff\xfe", 4);

std::string said_while_reading() {
  sapient::SapientMessage message;
  testing::internal::CaptureStderr();
  static_cast<void>(message.ParseFromString(kDamaged));
  return testing::internal::GetCapturedStderr();
}

TEST(ProtobufLog, DamagedMessagesAreCountedInPlaceOfALineEach) {
  EXPECT_NE(said_while_reading(), "") << "libprotobuf says nothing by itself: this test is void";
  const std::uint64_t before = protobuf_warnings();
  count_protobuf_warnings();
  count_protobuf_warnings();  // harmless
  EXPECT_EQ(said_while_reading(), "");
  EXPECT_EQ(said_while_reading(), "");
  EXPECT_EQ(protobuf_warnings(), before + 2);
}

}  // namespace
}  // namespace ols::exports
