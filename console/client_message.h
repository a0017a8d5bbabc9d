// What a browser says over its WebSocket: parsed strictly, refused in words. Pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "command/order.h"
#include "console/cue_orders.h"
#include "console/heard.h"
#include "console/procedures.h"
#include "geometry/wgs84.h"

namespace ols::console {

// `number`: the browser's own, repeated in the answer; 0 if it gave none.
struct CommandRequest {
  std::int64_t number = 0;
  command::Order order;
  // The console's time that the browser heard last [us UTC]: its own clock may be wrong. Rates have
  // it, others if it is given.
  std::optional<std::int64_t> heard_utime_us;
  std::optional<Geodetic> place = {};  // of kPoint: where to, instead of angles
};
struct StopAllRequest {
  std::int64_t number = 0;
};
struct ControlRequest {
  std::int64_t number = 0;
  std::string station;
  bool take = true;                            // from whoever has it; false: give it up
  std::optional<std::int64_t> heard_utime_us;  // as with a command
};
// Pictures of these stations are wanted from now on; of no others.
struct WatchRequest {
  std::vector<std::string> stations;
  Codec codec = Codec::kJpeg;
};
// The browser has dealt with the last picture of these stations, or with the last state.
struct TakenRequest {
  std::vector<std::string> stations;
  bool state = false;
};
// Of a replay: where it is to go, whether it runs, how fast. What is missing stays.
struct ReplayRequest {
  std::int64_t number = 0;
  std::optional<std::int64_t> at_us;
  std::optional<bool> playing;
  std::optional<double> speed;
};
// To the question of a guided procedure.
struct AnswerRequest {
  std::int64_t number = 0;
  ProcedureAnswer answer;
  std::optional<std::int64_t> heard_utime_us;  // as with a command
};
// Whether stations may be led to a cue.
struct CueRequest {
  std::int64_t number = 0;
  CueOrder order;
  std::optional<std::int64_t> heard_utime_us;  // as with a command
};
// Somebody looks after an alarm: an event of that number.
struct AcknowledgeRequest {
  std::int64_t number = 0;
  std::uint64_t event = 0;
};
// What operators call a target; empty: as the fusion does.
struct NameRequest {
  std::int64_t number = 0;
  std::string target;
  std::string name;
};
struct Refused {
  std::int64_t number = 0;
  std::string why;
};

using ClientMessage = std::variant<CommandRequest, StopAllRequest, ControlRequest, WatchRequest,
                                   TakenRequest, ReplayRequest, AnswerRequest, CueRequest,
                                   NameRequest, AcknowledgeRequest, Refused>;

inline constexpr std::size_t kMostMessageBytes = 8192;
inline constexpr std::size_t kMostWatched = 64;

// docs/console.md has the messages.
ClientMessage parse_client_message(std::string_view text);

}  // namespace ols::console
