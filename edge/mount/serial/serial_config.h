// The configuration of a pan-tilt head on a serial line. Pure.
#pragma once

#include <string>

#include "base/config/config_section.h"
#include "edge/mount/driven/drive.h"

namespace ols::serial_mount {

struct SerialConfig {
  SerialConfig();

  std::string device;
  int baud = 9600;
  int address = 1;         // the head's address; for Pelco-D only
  double timeout_s = 0.3;  // longest wait for an answer
  mount::DriveConfig drive;
};

enum class Language { kPelcoD, kVisca };
config::Section serial_section(SerialConfig& config, Language language);  // the section [mount]

}  // namespace ols::serial_mount
