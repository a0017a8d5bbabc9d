// The logger's configuration: settings, or one error that names the place.
#include "tools/logger/logger_config.h"

#include "base/config/toml_config.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const auto config =
        ols::logger::parse_logger_config(std::string(ols::fuzz::text(data, size)), "fuzz");
    ols::fuzz::require(config.quota_bytes > 0.0 && config.split_bytes > 0.0, "sizes are positive");
  } catch (const ols::ConfigError& error) {
    ols::fuzz::require(std::string(error.what()).find("fuzz") == 0, "an error names the file");
  }
  return 0;
}
