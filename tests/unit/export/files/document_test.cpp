#include "export/files/document.h"

#include <gtest/gtest.h>

#include "tests/unit/export/made_records.h"

namespace ols::exports {
namespace {

TEST(DocumentEncoder, WritesAtItsTurnsAndSendsCompanionsOnce) {
  DocumentEncoder encoder({},
                          [](const Picture& picture) {
                            return picture.is_empty() ? std::string()
                                                      : std::to_string(picture.tracks().size());
                          },
                          "-live", {{"link", "other"}});
  const Packets first = encoder.turn(kNow_us);
  ASSERT_EQ(first.size(), 1U);
  EXPECT_EQ(first[0].bytes, "other");
  EXPECT_TRUE(encoder.encode(made_target()).empty());
  const Packets second = encoder.turn(kNow_us);
  ASSERT_EQ(second.size(), 1U);
  EXPECT_EQ(second[0].bytes, "1");
  EXPECT_EQ(second[0].where, "-live");
  encoder.begin_again();
  EXPECT_EQ(encoder.turn(kNow_us).size(), 2U);
}

}  // namespace
}  // namespace ols::exports
