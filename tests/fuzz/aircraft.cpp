// Whatever a receiver of aircraft sends: Beast frames, SBS lines, aircraft.json.
#include <stdexcept>
#include <string>

#include "tools/calibrate/aircraft_feed.h"

using namespace ols::calibration;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  BeastFrames frames;
  AdsbDecoder decoder;
  std::int64_t utime_us = 1'780'000'000'000'000;
  for (const auto& frame : frames.take({data, size})) {
    decoder.take(frame.message, utime_us += 1000);
  }
  // Without the parity, which a fuzzer hardly finds, a message is its own bytes.
  for (std::size_t i = 0; i + 14 <= size; i += 14) decoder.take({data + i, 14}, utime_us += 1000);
  const std::string text(data, data + size);
  static_cast<void>(sbs_position(text));
  try {
    aircraft_json(text);
  } catch (const std::runtime_error&) {
    return 0;
  }
  return 0;
}
