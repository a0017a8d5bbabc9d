// What a head on a serial line may answer: a position is one that its language can say.
#include <cmath>

#include "edge/mount/serial/pelco_d.h"
#include "edge/mount/serial/visca_head.h"
#include "tests/fuzz/fuzz_input.h"

namespace {

namespace heads = ols::serial_mount;

void check(const std::optional<double>& position, double least, double below) {
  if (!position) return;
  ols::fuzz::require(*position >= least && *position < below, "a position is within its range");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes = ols::fuzz::text(data, size);
  heads::PelcoD pelco(1);
  heads::ViscaHead visca;
  for (std::size_t at = 0; at < bytes.size(); at += 5) {
    pelco.receive(bytes.substr(at, 5));
    visca.receive(bytes.substr(at, 5));
    for (const auto& axis : {pelco.position().pan, pelco.position().tilt}) check(axis, 0.0, 360.0);
    for (const auto& axis : {visca.position().pan, visca.position().tilt})
      check(axis, -32768.0, 32768.0);
  }
  return 0;
}
