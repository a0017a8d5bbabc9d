// SAPIENT names nodes by UUID and everything else by ULID. Both are computed from our own names, so
// that they stay the same over a restart. Pure.
#pragma once

#include <cstdint>
#include <string>

namespace ols::exports {

// Lower case and of version 4, which receivers insist on, though its bits are of a hash.
std::string uuid_of(const std::string& name);
bool is_uuid(const std::string& text);
// `time_ms`: since 1970; 0 for what has no time of its own, as an object.
std::string ulid_of(std::int64_t time_ms, const std::string& name);

}  // namespace ols::exports
