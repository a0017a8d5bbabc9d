// Searches for the devices that the answers do not name. If it finds several, a person chooses.
#pragma once

#include "tools/setup/answers.h"
#include "tools/setup/host.h"

namespace ols::setup {

// Adds the devices to the answers. `asks`: whether a person can be asked. Throws std::runtime_error
// naming the key with which a person can name the device.
void choose_devices(const Host& host, Answers& answers, bool asks);

}  // namespace ols::setup
