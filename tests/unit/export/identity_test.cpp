#include "export/identity.h"

#include <gtest/gtest.h>

namespace ols::exports {
namespace {

TEST(ExportIdentity, IsComputedFromWhatTheBusSays) {
  EXPECT_EQ(target_uid("brno", 0x1234, 7), "brno.target.0000000000001234.7");
  EXPECT_EQ(target_uid("brno", -1, 7), "brno.target.ffffffffffffffff.7");
  EXPECT_EQ(station_uid("brno", "alfa"), "brno.station.alfa");
  EXPECT_EQ(line_uid("brno", "alfa"), "brno.line.alfa");
}

}  // namespace
}  // namespace ols::exports
