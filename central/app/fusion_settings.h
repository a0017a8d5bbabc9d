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
  double slew_clock_tolerance_s = 2.0;  // a slew whose time is further from this host's clock is
                                        // withheld
  std::string land_folder;              // of `ols-land import`; empty: no land is known
  FusionConfig fusion{};
  trust::TrustConfig trust{};
};

config::Section fusion_section(FusionSettings& settings);  // the whole file
// Throws ConfigError ("file:line: key: what").
FusionSettings load_fusion_settings(const std::string& path);

}  // namespace ols::fusion
