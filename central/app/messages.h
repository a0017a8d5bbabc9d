// Translates between the fusion's types and LCM messages. Decides only whether a message is valid
// on its channel.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "base/bus/channel_names.h"
#include "central/fusion/fusion.h"
#include "ols_msg/command_reply_t.hpp"
#include "ols_msg/fusion_status_t.hpp"
#include "ols_msg/occlusion_t.hpp"
#include "ols_msg/slew_t.hpp"
#include "ols_msg/target_t.hpp"

namespace ols::fusion {

// Why a datagram is not a valid message on its channel; to_string() names the counter. kNoPosition
// is not an error: the station does not know its position yet.
enum class MessageRefusal { kMalformed, kSchema, kOtherStation, kOutOfRange, kNoPosition };
const char* to_string(MessageRefusal refusal);

// Never throws, for any bytes. The values are checked later, by check() of
// central/admission/bearing_check.h.
std::variant<BearingMeasurement, MessageRefusal> measurement_from(const std::string& channel,
                                                                  const void* data, int bytes);

// The part of a station's status that the fusion uses. Until the first bearing, the station's
// position is used as the camera centre.
struct StationPlace {
  std::string station;
  StationTraits traits;
  std::optional<MessageRefusal> no_place{};  // why the traits have no position
};
std::variant<StationPlace, MessageRefusal> station_place_from(const std::string& channel,
                                                              const void* data, int bytes);

std::variant<SkylineSector, MessageRefusal> skyline_sector_from(const std::string& channel,
                                                                const void* data, int bytes);

// The boot id of the fusion that sent the status.
std::variant<std::int64_t, MessageRefusal> fusion_boot_from(const void* data, int bytes);

// An operator's decision on a cue or a target, or a new mode of the hand-over.
struct CueOrder {
  std::string cue;
  bool allow = false;
  std::optional<HandoverMode> handover{};  // if set, it replaces a decision on `cue`
  std::int64_t utime_us = 0;
  double lease_s = 0.0;
  std::int64_t boot_id = 0, sequence = 0;
};
// The values of a cue are checked later, by check() of central/cues/cue_check.h.
std::variant<Cue, MessageRefusal> cue_from(const void* data, int bytes);
std::variant<CueOrder, MessageRefusal> cue_order_from(const void* data, int bytes);

// The answer to an order. `reason`: why the order is refused (the sentences are in
// wire/refusal_words.h); empty if the order is accepted.
struct CueReply {
  std::int64_t boot_id = 0, sequence = 0;  // id of the order
  std::string reason{};
};

// The sender's boot id, and the message's sequence number on its channel since that boot.
struct MessageStamp {
  std::int64_t boot_id = 0;
  std::int64_t sequence = 0;
};

ols_msg::target_t to_message(const FusedTarget& target, const MessageStamp& stamp);
ols_msg::command_reply_t to_message(const CueReply& reply, const MessageStamp& stamp,
                                    std::int64_t utime_us);
ols_msg::occlusion_t to_message(const OcclusionNotice& notice, const MessageStamp& stamp);
ols_msg::slew_t to_message(const Slew& slew, const MessageStamp& stamp);
ols_msg::fusion_status_t to_message(const FusionHealth& health, double latency_s,
                                    const MessageStamp& stamp);

}  // namespace ols::fusion
