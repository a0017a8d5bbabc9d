// Counts libprotobuf's warnings instead of printing them. The library prints one line on standard
// error for each damaged message, so damaged messages from others would fill the log.
#pragma once

#include <cstdint>

namespace ols::exports {

// Applies to the whole process. Call once, before there are threads.
void count_protobuf_warnings();
// Only increases.
std::uint64_t protobuf_warnings();

}  // namespace ols::exports
