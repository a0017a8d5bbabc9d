#include "export/text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "export/identity.h"
#include "export/uncertainty.h"
#include "tests/unit/export/made_records.h"

namespace ols::exports {
namespace {

TEST(ExportIdentity, IsComputedFromWhatTheBusSays) {
  EXPECT_EQ(target_uid("brno", 0x1234, 7), "brno.target.0000000000001234.7");
  EXPECT_EQ(target_uid("brno", -1, 7), "brno.target.ffffffffffffffff.7");
  EXPECT_EQ(station_uid("brno", "alfa"), "brno.station.alfa");
  EXPECT_EQ(line_uid("brno", "alfa"), "brno.line.alfa");
}

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

TEST(ExportUncertainty, TheEllipseOfACovariance) {
  const Ellipse north = ellipse_of({4.0, 0.0, 0.0, 9.0, 0.0, 1.0});
  EXPECT_DOUBLE_EQ(north.semi_major_m, 3.0);
  EXPECT_DOUBLE_EQ(north.semi_minor_m, 2.0);
  EXPECT_DOUBLE_EQ(north.azimuth_deg, 0.0);
  EXPECT_DOUBLE_EQ(ellipse_of({9.0, 0.0, 0.0, 4.0, 0.0, 1.0}).azimuth_deg, 90.0);
  // Towards the north-east: variances 5 along, 1 across.
  const Ellipse turned = ellipse_of({3.0, 2.0, 0.0, 3.0, 0.0, 1.0});
  EXPECT_DOUBLE_EQ(turned.azimuth_deg, 45.0);
  EXPECT_DOUBLE_EQ(turned.semi_major_m, std::sqrt(5.0));
  EXPECT_DOUBLE_EQ(ellipse_of({3.0, -2.0, 0.0, 3.0, 0.0, 1.0}).azimuth_deg, 135.0);
}

TEST(ExportUncertainty, NoCovarianceHasNoEllipse) {
  EXPECT_TRUE(std::isnan(ellipse_of({1.0, 2.0, 0.0, 1.0, 0.0, 1.0}).semi_major_m));
  EXPECT_TRUE(std::isnan(ellipse_of({kUnknown, 0.0, 0.0, 1.0, 0.0, 1.0}).semi_major_m));
  EXPECT_TRUE(std::isnan(sd(-1.0)));
}

TEST(ExportUncertainty, SpeedAndCourse) {
  Target target = made_target();
  const Motion motion = motion_of(target);
  EXPECT_DOUBLE_EQ(motion.speed_m_s, 5.0);
  EXPECT_NEAR(motion.course_deg, 36.8699, 1e-4);
  target.velocity_enu_m_s = {-1.0, 0.0, 0.0};
  EXPECT_DOUBLE_EQ(motion_of(target).course_deg, 270.0);
  target.velocity_enu_m_s[0] = kUnknown;
  EXPECT_TRUE(std::isnan(motion_of(target).speed_m_s));
}

TEST(Uncertainty, IsRoundedUp) {
  EXPECT_DOUBLE_EQ(rounded_up(0.004, 2), 0.01);
  EXPECT_DOUBLE_EQ(rounded_up(0.07, 2), 0.07);  // 100 times that is above 7
  EXPECT_DOUBLE_EQ(rounded_up(0.1501, 2), 0.16);
  EXPECT_DOUBLE_EQ(rounded_up(3.0, 0), 3.0);
  EXPECT_TRUE(std::isnan(rounded_up(kUnknown, 2)));
}

}  // namespace
}  // namespace ols::exports
