#include "export/sapient/registration.h"

#include "tests/unit/export/made_records.h"
#include "tests/unit/export/sapient/said.h"

namespace ols::exports {
namespace {

TEST(Registration, SaysWhatReportsHold) {
  const auto message = said(sapient_registration({.site = "brno", .status_s = 2.5}, kNow_us));
  const auto& registration = message.registration();
  EXPECT_EQ(registration.icd_version(), "BSI Flex 335 v2.0");
  EXPECT_EQ(registration.short_name(), "OLS brno");
  EXPECT_FLOAT_EQ(registration.status_definition().status_interval().value(), 2.5F);
  ASSERT_EQ(registration.mode_definition_size(), 1);
  const auto& detections = registration.mode_definition(0).detection_definition(0);
  EXPECT_EQ(detections.location_type().location_datum(), sapient::LOCATION_DATUM_WGS84_E);
  EXPECT_EQ(detections.velocity_type().enu_velocity_units().up_rate_units(),
            sapient::SPEED_UNITS_MS);
  for (const auto& field : detections.detection_report()) {
    EXPECT_TRUE(field.type().starts_with("ols.")) << field.type();
  }
  EXPECT_EQ(detections.detection_report_size(), 4);
}

}  // namespace
}  // namespace ols::exports
