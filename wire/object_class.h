// The name of an object's class.
#pragma once

#include <cstdint>

namespace ols::wire {

// CLASS_* of target_t: "unknown", "drone", "bird", "aircraft", "other".
const char* class_name(std::int8_t object_class);

}  // namespace ols::wire
