// Whatever the sources of cues send: bytes in any pieces, of each format. What is taken is finite.
#include <cmath>

#include "cue/input_reader.h"
#include "cue/live_cues.h"
#include "tests/fuzz/fuzz_input.h"

using namespace ols::cues;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::int64_t kNow_us = 1'795'428'930'000'000;
  ols::fuzz::Input input(data, size);
  const std::uint8_t kind = input.byte();
  // Three bits as ever, so that old seeds stay what they are; the fifth format is at 11 and 15.
  InputReader reader(static_cast<Format>((kind & 3) + (kind >> 3 & 1)), {"a-"}, (kind & 4) != 0,
                     [](double, double) { return 46.0; });
  InputRules rules;
  rules.name = "x";
  rules.max_age_s = 1e9;
  LiveCues desk({rules}, 4);
  while (!input.empty()) {
    const std::size_t piece = 1 + 16 * static_cast<std::size_t>(input.byte());
    desk.take(0, reader.take(input.take(piece), kNow_us), kNow_us);
  }
  for (const LiveCue& cue : desk.live(kNow_us)) {
    ols::fuzz::require(std::isfinite(cue.latitude_deg) && std::isfinite(cue.longitude_deg) &&
                           std::isfinite(cue.height_m) && cue.horizontal_sd_m > 0.0 &&
                           cue.vertical_sd_m > 0.0 && cue.velocity_sd_m_s > 0.0,
                       "a cue is finite");
  }
  return 0;
}
