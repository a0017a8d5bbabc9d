#include "cue/reading.h"

namespace ols::cues {

const char* to_string(Refusal refusal) {
  switch (refusal) {
    case Refusal::kMalformed:
      return "malformed";
    case Refusal::kNotFinite:
      return "not_finite";
    case Refusal::kOutOfRange:
      return "out_of_range";
    case Refusal::kPole:
      return "at_the_pole";
    case Refusal::kNoHeight:
      return "no_height";
    case Refusal::kStale:
      return "stale";
    case Refusal::kFuture:
      return "future";
    case Refusal::kOwn:
      return "own";
    case Refusal::kOtherType:
      return "other_type";
    case Refusal::kOutOfArea:
      return "out_of_area";
    case Refusal::kTooMany:
      return "too_many";
    case Refusal::kCount:
      break;
  }
  return "unknown";
}

}  // namespace ols::cues
