// A simulator's scenario: a world, or one error.
#include "sim/scenario/scenario.h"

#include "base/config/toml_config.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const auto scenario =
        ols::sim::parse_scenario(std::string(ols::fuzz::text(data, size)), "fuzz", "/nonexistent");
    ols::fuzz::require(!scenario.stations.empty(), "a scenario has stations");
  } catch (const ols::ConfigError&) {
    // Refused by name.
  }
  return 0;
}
