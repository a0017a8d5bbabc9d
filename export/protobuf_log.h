// Counts libprotobuf's warnings instead of printing them. The library prints a line on standard
// error for each damaged message; damaged messages from others would fill the log.
#pragma once

#include <cstdint>

namespace ols::exports {

// From now on counts warnings, for the whole process. Call once, before there are threads.
void count_protobuf_warnings();
// The number of warnings since then.
std::uint64_t protobuf_warnings();

}  // namespace ols::exports
