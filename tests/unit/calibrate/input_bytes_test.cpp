#include "tools/calibrate/input_bytes.h"

#include <gtest/gtest.h>

#include "tests/unit/base/bus/log_file.h"

namespace ols::calibration {
namespace {

TEST(InputBytes, AreThoseOfAllFilesOrNotKnown) {
  const LogFile three("abc"), five("defgh");
  EXPECT_EQ(input_bytes({three.path(), five.path()}), 8U);
  EXPECT_EQ(input_bytes({three.path(), "localhost:30005"}), 0U);
}

}  // namespace
}  // namespace ols::calibration
