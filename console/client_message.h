// The messages that a browser sends over its WebSocket. Parses them strictly; a message that is
// refused gets a reason in words. Pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "console/cue_orders.h"
#include "console/incidents/incident_book.h"
#include "console/procedures.h"
#include "console/received.h"
#include "geometry/wgs84.h"
#include "wire/order.h"

namespace ols::console {

// In all requests, `number` is chosen by the browser and repeated in the answer; 0: none.
struct CommandRequest {
  std::int64_t number = 0;
  wire::Order order;
  // The time of the console [us UTC] that the browser received last; it shows how old the command
  // is, even if the browser's clock is wrong. Required for rates, optional for other commands.
  std::optional<std::int64_t> heard_utime_us;
  std::optional<Geodetic> place = {};  // for kPoint: the place to point at, instead of angles
};
struct StopAllRequest {
  std::int64_t number = 0;
};
struct ControlRequest {
  std::int64_t number = 0;
  std::string station;
  bool take = true;                            // true: take control, also from the person who has
                                               // it; false: give it up
  std::optional<std::int64_t> heard_utime_us;  // as for a command
};
// From now on the browser wants pictures of these stations only.
struct WatchRequest {
  std::vector<std::string> stations;
  Codec codec = Codec::kJpeg;
};
// The browser has processed the last picture of these stations, or the last state.
struct TakenRequest {
  std::vector<std::string> stations;
  bool state = false;
};
// Where a replay should continue, whether it should play, and how fast. A value that is missing
// stays as it is.
struct ReplayRequest {
  std::int64_t number = 0;
  std::optional<std::int64_t> at_us;
  std::optional<bool> playing;
  std::optional<double> speed;
};
// The answer to a question of a guided procedure.
struct AnswerRequest {
  std::int64_t number = 0;
  ProcedureAnswer answer;
  std::optional<std::int64_t> heard_utime_us;  // as for a command
};
// An operator's decision whether stations may be slewed to a cue, or to whatever detectors find.
struct CueRequest {
  std::int64_t number = 0;
  wire::CueOrder order;
  std::optional<std::int64_t> heard_utime_us;  // as for a command
};
// Acknowledges an alarm: the person handles it. `event`: the alarm's number in the list of events.
struct AcknowledgeRequest {
  std::int64_t number = 0;
  std::uint64_t event = 0;
};
// Sets the operators' name for a target; empty: the name that the fusion gives it.
struct NameRequest {
  std::int64_t number = 0;
  std::string target;
  std::string name;
};
// Sets or removes an area.
struct AreaRequest {
  std::int64_t number = 0;
  AreaChange change;
};
// A person's judgement of an incident.
struct JudgeRequest {
  std::int64_t number = 0;
  IncidentJudgement judgement;
};
struct Refused {
  std::int64_t number = 0;
  std::string why;
};

using ClientMessage =
    std::variant<CommandRequest, StopAllRequest, ControlRequest, WatchRequest, TakenRequest,
                 ReplayRequest, AnswerRequest, CueRequest, NameRequest, AcknowledgeRequest,
                 AreaRequest, JudgeRequest, Refused>;

inline constexpr std::size_t kMostMessageBytes = 8192;
inline constexpr std::size_t kMostWatched = 64;

// Parses a message; docs/console.md describes all messages.
ClientMessage parse_client_message(std::string_view text);

}  // namespace ols::console
