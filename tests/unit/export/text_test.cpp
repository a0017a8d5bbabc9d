#include "export/text.h"

#include <gtest/gtest.h>

#include <limits>

namespace ols::exports {
namespace {

TEST(ExportText, NumbersHaveTheirDecimalsAndNoExponent) {
  EXPECT_EQ(fixed(-0.125, 2), "-0.12");
  EXPECT_EQ(fixed(1e10, 1), "10000000000.0");
  EXPECT_EQ(fixed(std::numeric_limits<double>::quiet_NaN(), 2), "");
  EXPECT_EQ(fixed(std::numeric_limits<double>::infinity(), 2), "");
}

TEST(ExportText, TimesAreUtc) {
  EXPECT_EQ(iso_time(0), "1970-01-01T00:00:00.000Z");
  EXPECT_EQ(iso_time(1'700'000'000'123'456), "2023-11-14T22:13:20.123Z");
  EXPECT_EQ(iso_time(1'709'164'800'000'000), "2024-02-29T00:00:00.000Z");
  EXPECT_EQ(iso_time(951'868'799'999'000), "2000-02-29T23:59:59.999Z");
  EXPECT_EQ(iso_time(4'107'542'400'000'000), "2100-03-01T00:00:00.000Z");
  EXPECT_EQ(iso_time(-5), "1970-01-01T00:00:00.000Z");
}

TEST(ExportText, XmlIsEscaped) {
  EXPECT_EQ(xml("a<b>&\"c\"\n"), "a&lt;b&gt;&amp;&quot;c&quot;?");
  EXPECT_EQ(xml("Brünn"), "Brünn");
}

}  // namespace
}  // namespace ols::exports
