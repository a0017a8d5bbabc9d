// The fusion's configuration file: docs/configuration.md.
#pragma once

#include <string>

#include "base/trust/trust_config.h"
#include "central/fusion/fusion.h"

namespace ols::config {
struct Section;
}
namespace ols::fusion {

struct FusionSettings {
  std::string lcm_url = "udpm://239.255.76.67:7667?ttl=0";
  double status_interval_s = 1.0;
  // A slew is withheld if its time differs more than this from the host's clock.
  double slew_clock_tolerance_s = 2.0;
  std::string land_folder;  // folder made by `ols-land import`; if empty, no land is known
  FusionConfig fusion{};
  trust::TrustConfig trust{};
};

config::Section fusion_section(FusionSettings& settings);  // describes the whole file
// Throws ConfigError ("file:line: key: what").
FusionSettings load_fusion_settings(const std::string& path);

}  // namespace ols::fusion
