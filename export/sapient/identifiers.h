// SAPIENT names nodes by UUID and everything else by ULID. Both are computed from our own names, so
// they survive a restart. Pure.
#pragma once

#include <cstdint>
#include <string>

namespace ols::exports {

// Lower case, and marked as version 4 because receivers insist on it, although its bits are a hash.
std::string uuid_of(const std::string& name);
bool is_uuid(const std::string& text);
// `time_ms`: since 1970; 0 if it has no time of its own, such as an object.
std::string ulid_of(std::int64_t time_ms, const std::string& name);

}  // namespace ols::exports
