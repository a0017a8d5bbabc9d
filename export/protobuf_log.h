// What libprotobuf says by itself of damaged messages: a line on standard error for each, which
// others' rubbish would fill a log with. It is counted in its place.
#pragma once

#include <cstdint>

namespace ols::exports {

// From now on, in the whole process. Call once, before there are threads.
void count_protobuf_warnings();
// Only goes up.
std::uint64_t protobuf_warnings();

}  // namespace ols::exports
