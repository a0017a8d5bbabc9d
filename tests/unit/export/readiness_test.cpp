#include "export/readiness.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace ols::exports {
namespace {

TEST(ExportReadiness, WithoutAGeoidNoHeightAboveTheSeaIsWritten) {
  ExportConfig config;
  config.geoid = "no_such_grid.gtx";
  for (const Format format : {Format::kKml, Format::kGpx, Format::kCourageous}) {
    EXPECT_THROW(site_context(config, {Format::kCot, format}), std::invalid_argument);
  }
  const SiteContext site = site_context(config, {Format::kCot, Format::kMqtt, Format::kGeoJson});
  EXPECT_TRUE(std::isnan(site.geoid_m(47.0, 13.0)));
}

TEST(ExportReadiness, AFileThatCannotBeReadIsNamed) {
  ExportConfig config;
  OutputConfig& output = config.outputs.emplace_back();
  output.name = "tak";
  EXPECT_NO_THROW(check_files(config));
  output.ca = "/no/such/ca.pem";
  EXPECT_THAT([&] { check_files(config); }, testing::ThrowsMessage<std::invalid_argument>(
                                                testing::HasSubstr("output tak: /no/such/ca.pem")));
}

}  // namespace
}  // namespace ols::exports
