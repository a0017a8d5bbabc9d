// libprotobuf's own warnings about damaged messages: a line on standard error for each. Damaged
// messages from others would fill the log, so they are counted instead.
#pragma once

#include <cstdint>

namespace ols::exports {

// Applies to the whole process. Call once, before there are threads.
void count_protobuf_warnings();
// Only increases.
std::uint64_t protobuf_warnings();

}  // namespace ols::exports
