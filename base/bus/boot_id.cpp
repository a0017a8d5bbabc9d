#include "base/bus/boot_id.h"

#include <random>

namespace ols {

std::int64_t draw_boot_id() {
  std::random_device source;
  return static_cast<std::int64_t>((static_cast<std::uint64_t>(source()) << 31U) ^ source());
}

}  // namespace ols
