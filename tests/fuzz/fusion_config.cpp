// The fusion's configuration file: settings, or one error that names the place.
#include "base/config/toml_config.h"
#include "central/app/fusion_settings.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const ols::fuzz::MemoryFile file(ols::fuzz::text(data, size));
  try {
    const ols::fusion::FusionSettings settings = ols::fusion::load_fusion_settings(file.path());
    ols::fuzz::require(settings.fusion.rate_hz > 0.0, "the fusion has a rate");
  } catch (const ols::ConfigError& error) {
    ols::fuzz::require(std::string(error.what()).find(file.path()) == 0, "an error names the file");
  }
  return 0;
}
