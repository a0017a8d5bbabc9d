// The identifiers of SAPIENT: a UUID for a node, a ULID for everything else. Both are computed from
// our own names; therefore they are the same after a restart. Pure.
#pragma once

#include <cstdint>
#include <string>

namespace ols::exports {

// The UUID in lower case. Its bits are a hash of the name, but it is marked as version 4 (random),
// because receivers insist on that.
std::string uuid_of(const std::string& name);
bool is_uuid(const std::string& text);
// `time_ms`: UTC since 1970; 0 for an object without a time.
std::string ulid_of(std::int64_t time_ms, const std::string& name);

}  // namespace ols::exports
