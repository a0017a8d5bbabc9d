// The kind of a unit, and its report on supply voltage and temperatures. Pure.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace ols::ptu {

enum class PtuModel {
  kUnknown,
  kClassic,  // PTU-D46 and similar, firmware 1 and 2
  kESeries,  // PTU-E46 and similar, firmware 3
};

// The kind according to the answer to V.
PtuModel ptu_model(std::string_view version_text);
// "PTU-D46 v2.12.1d1(C14/E)", "PTU-E46 v3.3.0", or the answer itself if it is neither.
std::string ptu_name(std::string_view version_text);

struct PtuEnvironment {
  double supply_V = 0.0;
  // A D46 has only one sensor, in its controller: head.
  std::optional<double> head_degC, pan_degC, tilt_degC;
};

// Parses the answer to O: `Input 30 VDC @ 86 degF` from a D46, `13.2,99,97,104` (volts; head, pan,
// tilt in degF) from an E46.
std::optional<PtuEnvironment> ptu_environment(std::string_view text);

}  // namespace ols::ptu
