// The words of chronyc, whatever they are.
#include <cmath>

#include "edge/clock/chrony_tracking.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto tracking = ols::clock::parse_chrony_tracking(ols::fuzz::text(data, size));
  if (tracking) {
    ols::fuzz::require(std::isfinite(tracking->offset_s) && tracking->error_s() >= 0.0,
                       "an offset is finite, an error positive");
  }
  return 0;
}
