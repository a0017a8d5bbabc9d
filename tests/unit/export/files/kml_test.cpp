#include "export/files/kml.h"

#include <gmock/gmock.h>

#include "tests/unit/export/made_records.h"

namespace ols::exports {
namespace {

using testing::HasSubstr;

TEST(ExportKml, HeightsAreAboveTheSea) {
  Picture picture;
  picture.take(made_target());
  picture.take(made_station());
  picture.take(made_line());
  const std::string text = kml(picture, 5000.0);
  EXPECT_THAT(text, HasSubstr("<gx:coord>13.25000000 47.50000000 54.00</gx:coord>"));
  EXPECT_THAT(text, HasSubstr("<when>2023-11-14T22:13:20.123Z</when>"));
  EXPECT_THAT(text, HasSubstr("13.20000000,47.40000000,554.00"));
  EXPECT_THAT(text, HasSubstr("<altitudeMode>absolute</altitudeMode>"));
  EXPECT_THAT(text, HasSubstr("<Data name=\"height_sd_m\"><value>5.00</value></Data>"));
}

TEST(ExportKml, ALinkNamesTheOtherFile) {
  const std::string text = kml_link("a&b-live.kml", 0.5);
  EXPECT_THAT(text, HasSubstr("<href>a&amp;b-live.kml</href>"));
  EXPECT_THAT(text, HasSubstr("<refreshInterval>0.50</refreshInterval>"));
}

}  // namespace
}  // namespace ols::exports
