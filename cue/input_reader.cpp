#include "cue/input_reader.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "cue/json_reader.h"

namespace ols::cues {
namespace {

// A datagram or a file is one whole message.
Framing framing_of(Format format, bool is_stream) {
  if (!is_stream) return Framing::kWhole;
  if (format == Format::kSapient) return Framing::kSapient;
  return format == Format::kCot ? Framing::kCot : Framing::kLines;
}

}  // namespace

InputReader::InputReader(Format format, CotTypes types, bool is_stream, GeoidHeight geoid_m)
    : format_(format),
      types_(std::move(types)),
      framer_(framing_of(format, is_stream)),
      sapient_(std::move(geoid_m)) {}

void InputReader::read(const std::string& message, std::int64_t now_us, Readings& readings) {
  Readings more;
  switch (format_) {
    case Format::kCot:
      more.push_back(cot_reading(message, types_));
      break;
    case Format::kAircraftJson:
      more = aircraft_json_readings(message);
      break;
    case Format::kSbs:
      more = sbs_.take(message, now_us);
      break;
    case Format::kJson:
      more.push_back(json_reading(message, now_us));
      break;
    case Format::kSapient:
      more = sapient_.take(message);
      break;
  }
  std::ranges::move(more, std::back_inserter(readings));
}

Readings InputReader::take(std::string_view bytes, std::int64_t now_us) {
  Readings readings;
  for (const std::string& message : framer_.take(bytes)) read(message, now_us, readings);
  for (; overlong_ < framer_.overlong(); ++overlong_) {
    readings.emplace_back(Refused{Refusal::kMalformed, "no end of a message in sight"});
  }
  return readings;
}

}  // namespace ols::cues
