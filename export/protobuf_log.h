// Replaces libprotobuf's warnings, one line on standard error for each damaged message, by a count.
// Damaged messages from others would otherwise fill the log.
#pragma once

#include <cstdint>

namespace ols::exports {

// Applies to the whole process. Call once, before there are threads.
void count_protobuf_warnings();
// Only increases.
std::uint64_t protobuf_warnings();

}  // namespace ols::exports
