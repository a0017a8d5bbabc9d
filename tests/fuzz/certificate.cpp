// A camera's certificate: whatever the bytes are, they have a key that can be pinned, or none.
#include "edge/device/certificate_key.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ols::device::check_pinned_key(ols::device::certificate_key({data, size}));
  ols::device::check_pinned_key(ols::device::certificate_key_of_pem(ols::fuzz::text(data, size)));
  return 0;
}
