#include "export/sapient/sapient_node.h"

#include "tests/unit/export/made_records.h"
#include "tests/unit/export/sapient/said.h"

namespace ols::exports {
namespace {

TEST(SapientNode, ASiteHasItsOwnNameOrTheGivenOne) {
  EXPECT_EQ(node_id({.site = "brno"}), node_id({.site = "brno"}));
  EXPECT_NE(node_id({.site = "wien"}), node_id({.site = "brno"}));
  EXPECT_EQ(node_id({.site = "brno", .node_id = "given"}), "given");
}

TEST(SapientNode, AMessageSaysWhoAndWhen) {
  const auto message = message_of({.node_id = "given"}, kNow_us);
  EXPECT_EQ(message.node_id(), "given");
  EXPECT_EQ(message.timestamp().seconds(), kNow_us / 1'000'000);
  EXPECT_EQ(message.timestamp().nanos(), 123'000'000);
}

}  // namespace
}  // namespace ols::exports
