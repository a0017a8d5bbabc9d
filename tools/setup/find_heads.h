// Finds pan-tilt heads on serial lines, by asking for their position. Moves nothing.
#pragma once

#include <string>
#include <vector>

#include "edge/mount/serial/serial_config.h"
#include "tools/setup/finders.h"

namespace ols::setup {

struct FoundHead {
  std::string device;
  serial_mount::Language language = serial_mount::Language::kVisca;
  int baud = 0;
  int address = 1;  // for Pelco-D only
};

// The lines on which a head reports its position, with the first rate at which it does.
std::vector<FoundHead> find_heads(const std::vector<std::string>& lines,
                                  serial_mount::Language language, int pelco_address);

// The head as a mount. A head does not state its scale and speed: usual values stand for them until
// they are measured. Pure.
Found found_head(const FoundHead& head);

}  // namespace ols::setup
