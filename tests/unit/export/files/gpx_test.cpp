#include "export/files/gpx.h"

#include <gmock/gmock.h>

#include "tests/unit/export/made_records.h"

namespace ols::exports {
namespace {

using testing::HasSubstr;

TEST(ExportGpx, HeightsAreAboveTheSeaAndTheGeoidIsNamed) {
  Picture picture;
  picture.take(made_target());
  picture.take(made_station());
  const std::string text = gpx(picture);
  EXPECT_THAT(text, HasSubstr("<trkpt lat=\"47.50000000\" lon=\"13.25000000\"><ele>54.00</ele>"
                              "<time>2023-11-14T22:13:20.123Z</time>"
                              "<geoidheight>46.00</geoidheight></trkpt>"));
  EXPECT_THAT(text, HasSubstr("<wpt lat=\"47.40000000\""));
}

TEST(ExportGpx, APauseBeginsANewSegment) {
  Picture picture;
  for (const std::int64_t after_s : {0, 1, 2, 8, 9}) {
    picture.take(made_target(7, after_s * 1'000'000));
  }
  const std::string text = gpx(picture);
  EXPECT_THAT(text, HasSubstr("</trkseg><trkseg>"));
  EXPECT_EQ(text.find("</trkseg><trkseg>"), text.rfind("</trkseg><trkseg>"));
}

}  // namespace
}  // namespace ols::exports
