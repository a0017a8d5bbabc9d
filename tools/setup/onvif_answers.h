// Makes the devices of a station from an ONVIF camera: the camera's stream becomes the station's
// camera, its motors become the mount. Pure.
#pragma once

#include <string>

#include "edge/mount/onvif/onvif_link.h"
#include "tools/setup/flat_toml.h"

namespace ols::setup {

// A stream in words, such as "main: H264, 1280 x 960, 25 Hz, turns".
std::string words_of(const onvif::Offer::Stream& stream);

struct OnvifLogin {
  std::string user, password_file;  // both empty: no login is needed
  std::string pinned_key{};         // of the camera's certificate; empty: none
};

// Adds the values that the answers under [station] lack. `url`: of the device service. If the
// camera does not report degrees, the scales of its angles are typical values until they are
// measured. Throws std::runtime_error if the answers request the camera as a mount, but it cannot
// move.
void add_onvif(Values& values, const std::string& url, const onvif::Offer::Stream& stream,
               const OnvifLogin& login);

}  // namespace ols::setup
