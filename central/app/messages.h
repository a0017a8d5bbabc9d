// Translation between the fusion's types and the LCM messages; nothing is decided here but whether
// a message is what its channel says.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "base/channel_names.h"
#include "central/fusion/fusion.h"
#include "ols_msg/fusion_status_t.hpp"
#include "ols_msg/slew_t.hpp"
#include "ols_msg/target_t.hpp"

namespace ols::fusion {

// Why a datagram is not the message that its channel promises; to_string() names the counter.
// kNoPosition: of a status whose station does not know it yet, which is no fault.
enum class MessageRefusal { kMalformed, kSchema, kOtherStation, kOutOfRange, kNoPosition };
const char* to_string(MessageRefusal refusal);

// Never throws, whatever the bytes. The numbers' values are left to check() of
// central/fusion/fusion.h.
std::variant<BearingMeasurement, MessageRefusal> sighting_from(const std::string& channel,
                                                               const void* data, int bytes);

// What a station's status tells of it. Its place is nearly the camera centre, until a bearing
// tells.
struct StationPlace {
  std::string station;
  StationTraits traits;
  std::optional<MessageRefusal> no_place{};  // why the traits have none
};
std::variant<StationPlace, MessageRefusal> station_place_from(const std::string& channel,
                                                              const void* data, int bytes);

// Which boot of a fusion the status is of.
std::variant<std::int64_t, MessageRefusal> fusion_boot_from(const void* data, int bytes);

// Who sends, and which message of its channel in this boot it is.
struct MessageStamp {
  std::int64_t boot_id = 0;
  std::int64_t sequence = 0;
};

ols_msg::target_t to_message(const FusedTarget& target, const MessageStamp& stamp);
ols_msg::slew_t to_message(const Slew& slew, const MessageStamp& stamp);
ols_msg::fusion_status_t to_message(const FusionHealth& health, double latency_s,
                                    const MessageStamp& stamp);

}  // namespace ols::fusion
