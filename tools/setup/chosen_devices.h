// Searches for the devices that the answers leave open. Of several, a person chooses.
#pragma once

#include "tools/setup/answers.h"
#include "tools/setup/host.h"

namespace ols::setup {

// Adds them to the answers. `asks`: a person is there. Throws std::runtime_error naming the key
// that would say which device it is.
void choose_devices(const Host& host, Answers& answers, bool asks);

}  // namespace ols::setup
