#include "tools/logger/logger_config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/config/toml_config.h"
#include "tests/unit/error_text.h"

namespace ols::logger {
namespace {

std::string error_of(const std::string& text) {
  return error_text<ConfigError>([&] { parse_logger_config(text, "logger.toml"); }, "accepted");
}

TEST(LoggerConfig, ReadsEachKey) {
  const LoggerConfig config = parse_logger_config(
      "folder = '/a'\nname = 'x-1'\nlcm_url = 'udpm://239.255.76.67:7668'\nchannels = 'A.*'\n"
      "invert = true\nsplit_mb = 10\nquota_gb = 1\ndisk_reserve_gb = 0.5\nmax_unwritten_mb = 5\n"
      "status_file = '/b'\n",
      "logger.toml");
  EXPECT_EQ(config.folder, "/a");
  EXPECT_EQ(config.name, "x-1");
  EXPECT_EQ(config.lcm_url, "udpm://239.255.76.67:7668");
  EXPECT_EQ(config.channels, "A.*");
  EXPECT_TRUE(config.invert);
  EXPECT_EQ(config.split_bytes, 10e6);
  EXPECT_EQ(config.quota_bytes, 1e9);
  EXPECT_EQ(config.disk_reserve_bytes, 0.5e9);
  EXPECT_EQ(config.max_unwritten_mb, 5.0);
  EXPECT_EQ(config.status_file, "/b");
}

TEST(LoggerConfig, RefusesWhatCannotWork) {
  using testing::HasSubstr;
  EXPECT_THAT(error_of("split_mb = 100\nquota_gb = 0.3\n"),
              HasSubstr("quota_gb: must be at least four"));
  EXPECT_THAT(error_of("name = 'a/b'\n"), HasSubstr("name: must be"));
  EXPECT_THAT(error_of("channels = '('\n"),
              HasSubstr("channels: \"(\" is not a regular expression"));
}

}  // namespace
}  // namespace ols::logger
