#include "export/readiness.h"

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
  try {
    check_files(config);
    FAIL();
  } catch (const std::invalid_argument& bad) {
    EXPECT_NE(std::string(bad.what()).find("output tak: /no/such/ca.pem"), std::string::npos)
        << bad.what();
  }
}

}  // namespace
}  // namespace ols::exports
