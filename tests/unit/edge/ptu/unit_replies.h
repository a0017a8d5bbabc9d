// The facts that a PTU-D46 reports about itself, and replies in the form in which the parser
// returns them.
#pragma once

#include <string>

#include "edge/ptu/codec.h"
#include "edge/ptu/start_sequence.h"
#include "geometry/angles.h"

namespace ols::ptu {

inline PtuFacts d46_facts() {
  const double step_rad = radians(11.5714 / 3600.0);
  return {{step_rad, -49467, 49467, 57, 18700, 18000},
          {step_rad, -14622, 9644, 57, 18700, 18000},
          "Pan-Tilt Controller v2.14.0"};
}

// The reply `* text`. `began_s`, `ended_s`: when its first and its last byte were read.
inline PtuReply reply(const std::string& text = {}, double began_s = 0.0, double ended_s = 0.0) {
  PtuReply made;
  made.text = text;
  if (!text.empty() && text.find_first_not_of("+-.0123456789") == std::string::npos) {
    made.number = std::stod(text);
  }
  made.began_s = began_s;
  made.ended_s = ended_s;
  return made;
}

inline PtuReply refusal(const std::string& text) {
  PtuReply made = reply(text);
  made.ok = false;
  return made;
}

}  // namespace ols::ptu
