// Turns the bytes of one input into readings. Pure.
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
  // `is_stream`: bytes come in any pieces; otherwise each piece is a whole message. `geoid_m`:
  // converts SAPIENT's heights above the geoid; without it, such heights are refused.
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
  int overlong_ = 0;  // the framer's count that has already been reported
};

}  // namespace ols::cues
