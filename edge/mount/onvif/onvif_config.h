// The configuration of an ONVIF camera as a mount. Pure.
#pragma once

#include <string>

#include "base/config/config_section.h"
#include "edge/mount/driven/drive.h"

namespace ols::onvif {

struct OnvifConfig {
  std::string url;   // address of the device service, without user and password
  std::string user;  // empty for no login
  // File whose first line is the password; it is read at each connection.
  std::string password_file;
  std::string profile;     // token of the camera's profile to use; if empty, the first one with PTZ
  std::string pinned_key;  // for https; see HttpLink::Config
  double timeout_s = 2.0;  // for one request with its answer
  mount::DriveConfig drive;
};

config::Section onvif_section(OnvifConfig& config);  // the section [mount]

}  // namespace ols::onvif
