#include "tools/doctor/finding.h"

#include <gtest/gtest.h>

namespace ols::doctor {
namespace {

TEST(Finding, IsOneLineWithWhatToDo) {
  EXPECT_EQ(line(ok("bus: by eth0")), "ok    bus: by eth0");
  EXPECT_EQ(line(warn("fusion: not heard", "look there")), "warn  fusion: not heard  — look there");
  EXPECT_EQ(line(fail("ptu: no answer", "check its supply")),
            "FAIL  ptu: no answer  — check its supply");
}

TEST(Finding, MovesNoCursor) { EXPECT_EQ(line(ok("ptu: \x1b[2J\nok")), "ok    ptu: ?[2J?ok"); }

TEST(Finding, TheGravestDecidesTheExitStatus) {
  EXPECT_EQ(exit_status({}), 0);
  EXPECT_EQ(exit_status({ok("a")}), 0);
  EXPECT_EQ(exit_status({ok("a"), warn("b", "c"), ok("d")}), 1);
  EXPECT_EQ(exit_status({fail("a", "b"), warn("c", "d")}), 2);
}

TEST(Finding, JsonHoldsWhateverADeviceSaid) {
  EXPECT_EQ(to_json({fail("ptu: \"!\\\x01\xff", "a")}),
            "{\n"
            "  \"verdict\": \"FAIL\",\n"
            "  \"findings\": [\n"
            "    {\n"
            "      \"verdict\": \"FAIL\",\n"
            "      \"what\": \"ptu: \\\"!\\\\??\",\n"
            "      \"advice\": \"a\"\n"
            "    }\n"
            "  ]\n"
            "}");
  EXPECT_EQ(to_json({}), "{\n  \"verdict\": \"ok\",\n  \"findings\": []\n}");
}

}  // namespace
}  // namespace ols::doctor
