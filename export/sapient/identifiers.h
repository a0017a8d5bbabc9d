// SAPIENT names nodes by UUID and everything else by ULID. Both are computed from our own names, so
// they survive a restart. Pure.
#pragma once

#include <cstdint>
#include <string>

namespace ols::exports {

// In lower case. It is marked as version 4 because receivers insist on that, although its bits are
// a hash.
std::string uuid_of(const std::string& name);
bool is_uuid(const std::string& text);
// `time_ms`: since 1970; 0 for an object without a time of its own.
std::string ulid_of(std::int64_t time_ms, const std::string& name);

}  // namespace ols::exports
