// A station's configuration file: settings, or one error that names the place.
#include "base/config/toml_config.h"
#include "edge/config/config.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const ols::fuzz::MemoryFile file(ols::fuzz::text(data, size));
  try {
    const ols::station::StationSettings settings = ols::station::load_station_settings(file.path());
    ols::fuzz::require(!settings.id.empty() && settings.id.size() <= 32, "a station has an id");
    ols::fuzz::require(settings.station.limits.pan_min_rad <= settings.station.limits.pan_max_rad,
                       "limits are in order");
  } catch (const ols::ConfigError& error) {
    ols::fuzz::require(std::string(error.what()).find(file.path()) == 0, "an error names the file");
  }
  return 0;
}
