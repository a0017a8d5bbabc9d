#include "tools/exporter/exporter_config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "base/config/toml_config.h"
#include "tests/unit/error_text.h"
#include "tests/unit/temp_dir.h"

namespace ols::exporter {
namespace {

using testing::HasSubstr;

std::string error_of(const std::string& text) {
  const std::string path = temp_dir() + "exporter.toml";
  std::ofstream(path) << text;
  return error_text<ConfigError>([&] { load_exporter_config(path); }, "accepted");
}

TEST(ExporterConfig, ReadsEachKey) {
  EXPECT_EQ(error_of(""), "accepted");
  EXPECT_EQ(error_of("lcm_url = 'udpm://239.255.76.67:7667?ttl=1'\naddress = '10.0.0.1:9316'\n"
                     "[trust]\nmode = 'require'\n"),
            "accepted");
}

TEST(ExporterConfig, AnErrorNamesLineAndKey) {
  EXPECT_THAT(error_of("\naddress = 'here'\n"), HasSubstr("exporter.toml:2: address"));
  EXPECT_THAT(error_of("port = 1\n"), HasSubstr("exporter.toml:1: port"));
  EXPECT_THAT(error_of("lcm_url = 'bogus://'\n"), HasSubstr("exporter.toml:1: lcm_url"));
}

}  // namespace
}  // namespace ols::exporter
