// The configuration of an ONVIF camera as a mount. Pure.
#pragma once

#include <string>

#include "base/config/config_section.h"
#include "edge/mount/driven/drive.h"

namespace ols::onvif {

struct OnvifConfig {
  std::string url;            // address of the device service, without user and password
  std::string user;           // empty: none
  std::string password_file;  // the password is its first line; read at each connection
  std::string profile;        // token of the profile; empty: the first one with PTZ
  std::string pinned_key;     // as in HttpLink::Config, for https
  double timeout_s = 2.0;     // for a request
  mount::DriveConfig drive;
};

config::Section onvif_section(OnvifConfig& config);  // the section [mount]

}  // namespace ols::onvif
