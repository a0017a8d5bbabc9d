// An ONVIF camera as the devices of a station: its stream is the camera, its motion the mount.
// Pure.
#pragma once

#include <string>

#include "edge/mount/onvif/onvif_link.h"
#include "tools/setup/flat_toml.h"

namespace ols::setup {

// "main: H264, 1280 x 960, 25 Hz, turns".
std::string words_of(const onvif::Offer::Stream& stream);

struct OnvifLogin {
  std::string user, password_file;  // both empty: none is needed
};

// Fills in what the answers, under [station], leave open. `url`: of the device service. A camera
// that reports no degrees gets scales that are usual, until they are measured. Throws
// std::runtime_error if its motion is wanted and it has none.
void add_onvif(Values& values, const std::string& url, const onvif::Offer::Stream& stream,
               const OnvifLogin& login);

}  // namespace ols::setup
