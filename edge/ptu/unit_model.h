// Parses a unit's answers about its model (V) and about supply voltage and temperatures (O). Pure.
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

// The model, from the answer to V.
PtuModel ptu_model(std::string_view version_text);
// The model's name, from the answer to V: "PTU-D46 v2.12.1d1(C14/E)", "PTU-E46 v3.3.0", or the
// answer itself for an unknown model.
std::string ptu_name(std::string_view version_text);

struct PtuEnvironment {
  double supply_V = 0.0;
  // A D46 states only head_degC, from the sensor in its controller.
  std::optional<double> head_degC, pan_degC, tilt_degC;
};

// Parses the answer to O. A D46 answers `Input 30 VDC @ 86 degF`. An E46 answers `13.2,99,97,104`:
// volts, then the temperatures of head, pan and tilt in degF. nullopt for other texts and
// implausible values.
std::optional<PtuEnvironment> ptu_environment(std::string_view text);

}  // namespace ols::ptu
