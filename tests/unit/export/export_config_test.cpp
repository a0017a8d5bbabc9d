#include "export/export_config.h"

#include <gmock/gmock.h>

#include "base/config/toml_config.h"
#include "tests/unit/error_text.h"

namespace ols::exports {
namespace {

using testing::HasSubstr;

ExportConfig parsed(const std::string& text) { return parse_export_config(text, "export.toml"); }

std::string complaint(const std::string& text) {
  return error_text<ConfigError>([&] { parsed(text); }, "none");
}

std::string output(const std::string& more) { return "[[output]]\nname = \"a\"\n" + more; }

TEST(ExportConfig, NothingGoesOutByDefault) { EXPECT_TRUE(parsed("").outputs.empty()); }

TEST(ExportConfig, OutputsKeepTheirOwnKeys) {
  const ExportConfig config =
      parsed(output("format = \"cot\"\nto = \"udp://239.2.3.1:6969\"\nrate_hz = 5.0\n") +
             "[[output]]\nname = \"b\"\nformat = \"kml\"\nto = \"file:///srv/a.kml\"\n"
             "area_deg = [47.0, 13.0, 48.0, 14.0]\n");
  ASSERT_EQ(config.outputs.size(), 2U);
  EXPECT_EQ(config.outputs[0].gate.rate_hz, 5.0);
  EXPECT_EQ(config.outputs[1].gate.rate_hz, 2.0);
  EXPECT_EQ(config.outputs[1].gate.area_deg[3], 14.0);
  EXPECT_EQ(config.outputs[1].format, Format::kKml);
  EXPECT_TRUE(needs_geoid(Format::kKml));
  EXPECT_FALSE(needs_geoid(Format::kCot));
}

TEST(ExportConfig, SaysWhatIsWrongWhere) {
  EXPECT_THAT(complaint(output("format = \"cot\"\nto = \"file:///a\"\n")),
              HasSubstr("the format cot cannot be sent to file://"));
  EXPECT_THAT(complaint(output("format = \"cot\"\nto = \"udp://here:1\"\n")),
              HasSubstr("export.toml:4: output"));
  const std::string good = output("format = \"cot\"\nto = \"udp://1.1.1.1:1\"\n");
  EXPECT_EQ(complaint(good), "none");
  EXPECT_THAT(complaint(good + good), HasSubstr("two have the name"));
  EXPECT_THAT(complaint(good + "key = \"/a\"\n"), HasSubstr("belong together"));
  EXPECT_THAT(complaint(good + "area_deg = [48.0, 13.0, 47.0, 14.0]\n"), HasSubstr("south"));
  EXPECT_THAT(complaint(good + "password_file = \"/a\"\n"), HasSubstr("user"));
  EXPECT_THAT(complaint("site = \"a b\"\n"), HasSubstr("site"));
  EXPECT_THAT(complaint(output("format = \"sapient\"\nto = \"udp://1.1.1.1:1\"\n")),
              HasSubstr("the format sapient cannot be sent to udp://"));
  EXPECT_THAT(complaint("[sapient]\nnode_id = \"brno\"\n"), HasSubstr("not a UUID of version 4"));
  const std::string courageous =
      output("format = \"courageous\"\nto = \"file:///a\"\nstations = false\n");
  EXPECT_THAT(complaint(courageous), HasSubstr("courageous demands the place"));
  EXPECT_THAT(complaint(courageous + "[courageous]\nlatitude_deg = 49.0\n"),
              HasSubstr("belong together"));
  EXPECT_EQ(complaint(courageous + "[courageous]\nlatitude_deg = 49.0\nlongitude_deg = 16.0\n"
                                   "height_above_sea_m = 230.0\n"),
            "none");
  EXPECT_THAT(complaint("[mqtt]\nprefix = \"a/#\"\n"), HasSubstr("prefix"));
  EXPECT_THAT(complaint("[cot]\ntarget_type = \"a\\\"b\"\n"), HasSubstr("target_type"));
}

TEST(ExportConfig, FormatsByTheirNames) {
  EXPECT_EQ(format_from("gpx"), Format::kGpx);
  EXPECT_THROW(format_from("doc"), std::invalid_argument);
}

}  // namespace
}  // namespace ols::exports
