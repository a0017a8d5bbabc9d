// What an inclinometer's line may say. However the bytes are cut, the angles are the same, and none
// is beyond the range.
#include <cmath>

#include "edge/sensors/dpg2/dpg2_parser.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr double kRange_rad = 0.7;
  ols::fuzz::Input input(data, size);
  const bool version = input.byte() % 2 == 1;
  const std::string_view bytes = input.rest();
  ols::sensors::Dpg2Parser whole(kRange_rad), split(kRange_rad);
  if (version) {
    whole.expect_version();
    split.expect_version();
  }
  const auto at_once = whole.receive(bytes, 1.0);
  std::vector<ols::sensors::AxisAngles> by_byte;
  for (const char byte : bytes) {
    for (const auto& angles : split.receive({&byte, 1}, 1.0)) by_byte.push_back(angles);
  }
  ols::fuzz::require(at_once.size() == by_byte.size(), "split bytes give as many readings");
  ols::fuzz::require(whole.version() == split.version(), "and the same version");
  for (std::size_t i = 0; i < at_once.size(); ++i) {
    ols::fuzz::require(at_once[i].x_rad == by_byte[i].x_rad && at_once[i].y_rad == by_byte[i].y_rad,
                       "and the same angles");
    ols::fuzz::require(
        std::abs(at_once[i].x_rad) <= kRange_rad && std::abs(at_once[i].y_rad) <= kRange_rad,
        "within the range");
  }
  return 0;
}
