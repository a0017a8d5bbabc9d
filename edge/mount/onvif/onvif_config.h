// The configuration of an ONVIF camera as a mount. Pure.
#pragma once

#include <string>

#include "base/config/config_section.h"
#include "edge/mount/onvif/drive.h"

namespace ols::onvif {

struct OnvifConfig {
  std::string url;            // of the device service, without user and password
  std::string user;           // empty: none
  std::string password_file;  // its first line; read at each connection
  std::string profile;        // token; empty: the first with PTZ
  std::string pinned_key;     // of an https camera: "sha256//..."
  double timeout_s = 2.0;     // of a request
  DriveConfig drive;
};

config::Section onvif_section(OnvifConfig& config);  // of [mount]

}  // namespace ols::onvif
