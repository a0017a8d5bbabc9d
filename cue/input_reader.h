// Turns the bytes of one input into readings, in any of the formats. Pure.
#pragma once

#include <cstdint>
#include <string_view>

#include "cue/aircraft_reader.h"
#include "cue/cot_reader.h"
#include "cue/cue_config.h"
#include "cue/framing.h"
#include "cue/sapient_reader.h"

namespace ols::cues {

class InputReader {
 public:
  // `is_stream`: true: the bytes come in pieces of any size; false: each piece is a whole message.
  // `geoid_m`: converts SAPIENT's heights above the geoid; if empty, such heights are refused.
  InputReader(Format format, CotTypes types, bool is_stream, GeoidHeight geoid_m = {});

  Readings take(std::string_view bytes, std::int64_t now_us);
  // Call when the connection starts again.
  void clear() { framer_.clear(); }

 private:
  void read(const std::string& message, std::int64_t now_us, Readings& readings);

  Format format_;
  CotTypes types_;
  Framer framer_;
  SbsReader sbs_;
  SapientReader sapient_;
  int overlong_ = 0;  // the part of framer_.overlong() that has been reported
};

}  // namespace ols::cues
