// What a server of GPIO lines may say. However the bytes are cut, the levels are the same, until
// there is one that is none.
#include "edge/gpio/line_protocol.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::vector<int> inputs{17, 18};
  const std::string_view bytes = ols::fuzz::text(data, size);
  ols::gpio::LineProtocol whole(inputs), split(inputs);
  const auto at_once = whole.receive(bytes);
  std::vector<ols::gpio::LineProtocol::Level> by_byte;
  bool refused = false;
  for (std::size_t i = 0; i < bytes.size() && !refused; ++i) {
    const auto levels = split.receive(bytes.substr(i, 1));
    refused = !levels;
    if (levels) by_byte.insert(by_byte.end(), levels->begin(), levels->end());
  }
  ols::fuzz::require(at_once.has_value() == !refused, "split bytes are refused as the whole is");
  if (at_once) ols::fuzz::require(*at_once == by_byte, "and give the same levels");
  return 0;
}
