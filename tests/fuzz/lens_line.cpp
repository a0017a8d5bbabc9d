// What a lens' line may say: the driver goes on asking, and every position is a share of the
// travel.
#include "edge/lens/lens_driver.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ols::lens::LensDriver driver(0.05);
  ols::lens::LensOrder order;
  order.axes.zoom = ols::lens::AxisOrder{0.5, 0.0, 0.0};
  order.axes.iris = ols::lens::AxisOrder{std::nullopt, 1.0, 5.0};
  driver.order(order);
  double time_s = 1.0;
  for (const char byte : ols::fuzz::text(data, size)) {
    time_s += 0.01;
    const std::string request = driver.step(time_s);
    ols::fuzz::require(request.size() <= 16, "a packet has at most 16 bytes");
    driver.receive({&byte, 1}, time_s);
  }
  for (const auto& sample : driver.take_samples()) {
    ols::fuzz::require(sample.position >= 0.0 && sample.position <= 1.0, "within the travel");
    ols::fuzz::require(sample.time_sd_s >= 0.0 && sample.time_s <= time_s, "dated");
  }
  return 0;
}
