// Conversions between a configuration file and internal values: degrees to radians, names to lens
// models.
#pragma once

#include "base/config/config_section.h"
#include "geometry/angles.h"
#include "geometry/lens.h"

namespace ols::station {

inline config::Unit in_degrees(const char* name = "deg") { return {name, radians, degrees}; }

inline config::Words<LensModel> lens_model_words() {
  config::Words<LensModel> words;
  for (const char* name : kLensModelNames) {
    words.emplace_back(name, static_cast<LensModel>(words.size()));
  }
  return words;
}

}  // namespace ols::station
