// Converts texts signed by the site's root to bus messages and back. Also reads what verification
// must know about an order.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/trust/crypto.h"
#include "ols_msg/site_settings_t.hpp"
#include "ols_msg/trust_list_t.hpp"

namespace ols::trust {

ols_msg::trust_list_t to_message(const std::string& list, std::int64_t boot_id,
                                 std::int64_t sequence, std::int64_t utime_us);
ols_msg::site_settings_t to_settings_message(const std::string& settings, std::int64_t boot_id,
                                             std::int64_t sequence, std::int64_t utime_us);
// The text of a trust list or of site settings, not yet verified; nullopt if the payload is another
// message.
std::optional<std::string> list_from(Bytes payload);
std::optional<std::string> settings_from(Bytes payload);
// Whether a station would read the payload as an order to stop. Accepts any schema number, as the
// station does.
bool is_stop(Bytes payload);

}  // namespace ols::trust
