#include "console/client_message.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "base/text/plain_text.h"
#include "geometry/angles.h"
#include "geometry/slew_limits.h"

namespace ols::console {
namespace {

using Json = nlohmann::json;
using wire::Kind;

constexpr std::size_t kMostNameBytes = 64;
constexpr double kMostPixels = 1e5;
constexpr double kMostRecord_s = 3600.0;

// What is wrong with a message, in words. Only the parser throws and catches it.
class FormError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

double number_of(const Json& value, const std::string& what, double least, double greatest) {
  if (!value.is_number()) throw FormError(what + " must be a number");
  const double number = value.get<double>();
  if (!(number >= least && number <= greatest)) {
    throw FormError(what + " must be within " + Json(least).dump() + " and " +
                    Json(greatest).dump());
  }
  return number;
}

const Json& field(const Json& message, const char* key) {
  const auto found = message.find(key);
  if (found == message.end()) throw FormError(std::string(key) + " is missing");
  return *found;
}

double number(const Json& message, const char* key, double least, double greatest) {
  return number_of(field(message, key), key, least, greatest);
}

std::string name_of(const Json& value, const std::string& what) {
  if (!value.is_string()) throw FormError(what + " must be a text");
  const auto name = value.get<std::string>();
  const bool printable = std::ranges::all_of(name, [](char c) { return c > ' ' && c < 127; });
  if (name.empty() || name.size() > kMostNameBytes || !printable) {
    throw FormError(what + " must be 1 to 64 printable characters without spaces");
  }
  return name;
}

std::string text(const Json& message, const char* key) { return name_of(field(message, key), key); }

using Keys = std::initializer_list<std::string_view>;
constexpr Keys kNoKeys{};

void refuse_unknown(const Json& message, Keys known, Keys more = kNoKeys) {
  for (const auto& [key, value] : message.items()) {
    if (std::ranges::find(known, key) == known.end() && std::ranges::find(more, key) == more.end())
      throw FormError("unknown key " + Json(key).dump());
  }
}

// Refuses keys that are neither this command's own nor common to all commands.
void refuse_others(const Json& message, Keys own) {
  refuse_unknown(message, {"do", "number", "station", "command", "heard_us"}, own);
}

std::int64_t whole(const Json& message, const char* key) {
  const Json& value = field(message, key);
  if (!value.is_number_integer()) throw FormError(std::string(key) + " must be a whole number");
  return static_cast<std::int64_t>(number_of(value, key, 0.0, 9e15));
}

// When the browser last heard something, if it says so.
std::optional<std::int64_t> heard(const Json& message) {
  if (!message.contains("heard_us")) return std::nullopt;
  return whole(message, "heard_us");
}

void read_box(const Json& message, wire::Order& order) {
  refuse_others(message, {"frame_utime_us", "box_px"});
  const Json& box = field(message, "box_px");
  if (!box.is_array() || box.size() != 4) throw FormError("box_px must be [x, y, width, height]");
  order.x_px = number_of(box[0], "box_px", -kMostPixels, kMostPixels);
  order.y_px = number_of(box[1], "box_px", -kMostPixels, kMostPixels);
  order.width_px = number_of(box[2], "box_px", 0.5, kMostPixels);
  order.height_px = number_of(box[3], "box_px", 0.5, kMostPixels);
  if (!message.contains("frame_utime_us")) return;
  order.frame_utime_us = whole(message, "frame_utime_us");
}

void read_point(const Json& message, wire::Order& order) {
  refuse_others(message, {"frame_utime_us", "point_px"});
  const Json& point = field(message, "point_px");
  if (!point.is_array() || point.size() != 2) throw FormError("point_px must be [x, y]");
  order.x_px = number_of(point[0], "point_px", -kMostPixels, kMostPixels);
  order.y_px = number_of(point[1], "point_px", -kMostPixels, kMostPixels);
  if (message.contains("frame_utime_us")) order.frame_utime_us = whole(message, "frame_utime_us");
}

Geodetic read_place(const Json& message) {
  constexpr double kLowest_m = -1e3, kHighest_m = 1e5;
  refuse_others(message, {"latitude_deg", "longitude_deg", "height_m"});
  return {radians(number(message, "latitude_deg", -90.0, 90.0)),
          radians(number(message, "longitude_deg", -180.0, 180.0)),
          number(message, "height_m", kLowest_m, kHighest_m)};
}

void read_angles(const Json& message, wire::Order& order) {
  refuse_others(message, {"pan_deg", "tilt_deg"});
  const double pan = degrees(kPointPanLimit_rad), tilt = degrees(kPointTiltLimit_rad);
  order.pan_rad = radians(number(message, "pan_deg", -pan, pan));
  order.tilt_rad = radians(number(message, "tilt_deg", -tilt, tilt));
}

void read_rate(const Json& message, CommandRequest& request) {
  refuse_others(message, {"pan_deg_s", "tilt_deg_s"});
  const double most = degrees(kRateLimit_rad_s);
  request.order.pan_rate_rad_s = radians(number(message, "pan_deg_s", -most, most));
  request.order.tilt_rate_rad_s = radians(number(message, "tilt_deg_s", -most, most));
}

double axis(const Json& message, const char* key, bool is_rate) {
  if (!message.contains(key)) return wire::kNaN;
  return number(message, key, is_rate ? -1.0 : 0.0, 1.0);
}

void read_lens(const Json& message, CommandRequest& request) {
  refuse_others(message, {"is_rate", "zoom", "focus", "iris"});
  const Json& is_rate = field(message, "is_rate");
  if (!is_rate.is_boolean()) throw FormError("is_rate must be true or false");
  wire::Order& order = request.order;
  order.lens_rates = is_rate.get<bool>();
  order.zoom = axis(message, "zoom", order.lens_rates);
  order.focus = axis(message, "focus", order.lens_rates);
  order.iris = axis(message, "iris", order.lens_rates);
}

void read_record(const Json& message, wire::Order& order) {
  refuse_others(message, {"before_s", "after_s", "label"});
  order.before_s = number(message, "before_s", 0.0, kMostRecord_s);
  order.after_s = number(message, "after_s", 0.0, kMostRecord_s);
  order.label = text(message, "label");
}

CommandRequest read_command(const Json& message, std::int64_t number) {
  CommandRequest request{.number = number};
  request.order.station = text(message, "station");
  const auto kind = wire::kind_named(text(message, "command"));
  if (!kind) throw FormError("unknown command");
  request.order.kind = *kind;
  switch (*kind) {
    case Kind::kDesignate:
      read_box(message, request.order);
      break;
    case Kind::kPoint:
      if (message.contains("latitude_deg")) {
        request.place = read_place(message);
      } else {
        read_angles(message, request.order);
      }
      break;
    case Kind::kCentre:
    case Kind::kLook:
      read_point(message, request.order);
      break;
    case Kind::kLens:
      read_lens(message, request);
      break;
    case Kind::kRate:
      read_rate(message, request);
      break;
    case Kind::kRecord:
      read_record(message, request.order);
      break;
    default:
      refuse_others(message, {});
  }
  request.heard_utime_us =
      wire::is_joystick(request.order) ? whole(message, "heard_us") : heard(message);
  return request;
}

std::vector<std::string> stations_of(const Json& message) {
  const Json& pictures = field(message, "pictures");
  if (!pictures.is_array() || pictures.size() > kMostWatched) {
    throw FormError("pictures must be a list of at most 64 stations");
  }
  std::vector<std::string> stations;
  for (const Json& station : pictures) stations.push_back(name_of(station, "pictures"));
  return stations;
}

TakenRequest read_taken(const Json& message) {
  refuse_unknown(message, {"do", "number", "pictures", "state"});
  const Json& state = field(message, "state");
  if (!state.is_boolean()) throw FormError("state must be true or false");
  return {stations_of(message), state.get<bool>()};
}

WatchRequest read_watch(const Json& message) {
  refuse_unknown(message, {"do", "number", "pictures", "codec"});
  WatchRequest request;
  request.stations = stations_of(message);
  if (!message.contains("codec")) return request;
  const Json& codec = message.at("codec");
  if (codec != "jpeg" && codec != "h264") throw FormError("codec must be jpeg or h264");
  request.codec = codec == "h264" ? Codec::kH264 : Codec::kJpeg;
  return request;
}

ReplayRequest read_replay(const Json& message, std::int64_t of_browser) {
  refuse_unknown(message, {"do", "number", "at_us", "playing", "speed"});
  ReplayRequest request{of_browser, {}, {}, {}};
  if (message.contains("at_us")) {
    request.at_us = static_cast<std::int64_t>(number(message, "at_us", 0.0, 9e15));
  }
  if (message.contains("playing")) {
    if (!message.at("playing").is_boolean()) throw FormError("playing must be true or false");
    request.playing = message.at("playing").get<bool>();
  }
  if (message.contains("speed")) request.speed = number(message, "speed", 0.1, 100.0);
  return request;
}

// Two numbers, where they are given.
std::optional<std::array<double, 2>> pair(const Json& message, const char* key, double most) {
  if (!message.contains(key)) return std::nullopt;
  const Json& value = message.at(key);
  if (!value.is_array() || value.size() != 2)
    throw FormError(std::string(key) + " must be two numbers");
  return std::array{number_of(value[0], key, -most, most), number_of(value[1], key, -most, most)};
}

AnswerRequest read_answer(const Json& message, std::int64_t of_browser) {
  constexpr double kMostTurn_deg = 360.0;
  refuse_unknown(message, {"do", "number", "station", "question", "choice", "pixel_px", "turn_deg",
                           "heard_us"});
  AnswerRequest request{of_browser, {}, {}};
  ProcedureAnswer& answer = request.answer;
  answer.station = text(message, "station");
  answer.question = whole(message, "question");
  answer.choice = text(message, "choice");
  answer.pixel_px = pair(message, "pixel_px", kMostPixels);
  answer.turn_deg = pair(message, "turn_deg", kMostTurn_deg).value_or(answer.turn_deg);
  request.heard_utime_us = heard(message);
  return request;
}

// A person's text: any, made harmless for display.
std::string words_of(const Json& message, const char* key, std::size_t most) {
  const Json& value = field(message, key);
  if (!value.is_string() || value.get_ref<const std::string&>().size() > most) {
    throw FormError(std::string(key) + " must be a text of at most " + std::to_string(most) +
                    " characters");
  }
  return plain_text(value.get_ref<const std::string&>());
}

NameRequest read_name(const Json& message, std::int64_t number) {
  constexpr std::size_t kMostBytes = 40;
  refuse_unknown(message, {"do", "number", "target", "name", "heard_us"});
  return {number, text(message, "target"), words_of(message, "name", kMostBytes)};
}

// Other systems name cues, so the name is any text.
CueRequest read_cue(const Json& message, std::int64_t number) {
  refuse_unknown(message, {"do", "number", "cue", "allow", "heard_us"});
  const Json& cue = field(message, "cue");
  constexpr std::size_t kMostCueBytes = 100;
  if (!cue.is_string() || cue.get_ref<const std::string&>().size() > kMostCueBytes) {
    throw FormError("cue must be a text of at most 100 characters");
  }
  const Json& allow = field(message, "allow");
  if (!allow.is_boolean()) throw FormError("allow must be true or false");
  return {number, {cue.get<std::string>(), allow.get<bool>()}, heard(message)};
}

CueRequest read_handover(const Json& message, std::int64_t number) {
  refuse_unknown(message, {"do", "number", "mode", "heard_us"});
  const std::string mode = text(message, "mode");
  if (mode != "off" && mode != "propose" && mode != "automatic") {
    throw FormError("mode must be off, propose or automatic");
  }
  return {number, {.cue = {}, .allow = mode != "off", .handover = mode}, heard(message)};
}

// The area is parsed where it is kept.
AreaRequest read_area(const Json& message, std::int64_t number) {
  refuse_unknown(message, {"do", "number", "area"});
  const Json& area = field(message, "area");
  if (!area.is_object()) throw FormError("area must be an object");
  return {number, {.area = area, .name = {}}};
}

JudgeRequest read_judgement(const Json& message, std::int64_t number) {
  refuse_unknown(message, {"do", "number", "incident", "verdict"});
  const auto verdict = judgement_named(text(message, "verdict"));
  if (!verdict) throw FormError("verdict must be open, confirmed or dismissed");
  return {number, {static_cast<std::uint64_t>(whole(message, "incident")), *verdict}};
}

ClientMessage read(const Json& message, std::int64_t number) {
  const std::string what = text(message, "do");
  if (what == "command") return read_command(message, number);
  if (what == "watch") return read_watch(message);
  if (what == "taken") return read_taken(message);
  if (what == "replay") return read_replay(message, number);
  if (what == "answer") return read_answer(message, number);
  if (what == "cue") return read_cue(message, number);
  if (what == "handover") return read_handover(message, number);
  if (what == "name") return read_name(message, number);
  if (what == "area") return read_area(message, number);
  if (what == "remove_area") {
    refuse_unknown(message, {"do", "number", "name"});
    constexpr std::size_t kMostBytes = 40;
    return AreaRequest{number, {.area = {}, .name = words_of(message, "name", kMostBytes)}};
  }
  if (what == "judge") return read_judgement(message, number);
  if (what == "stop_all") {
    refuse_unknown(message, {"do", "number"});
    return StopAllRequest{number};
  }
  if (what == "acknowledge") {
    refuse_unknown(message, {"do", "number", "event"});
    return AcknowledgeRequest{number, static_cast<std::uint64_t>(whole(message, "event"))};
  }
  if (what == "take" || what == "give_up") {
    refuse_unknown(message, {"do", "number", "station", "heard_us"});
    return ControlRequest{number, text(message, "station"), what == "take", heard(message)};
  }
  throw FormError(
      "do must be command, stop_all, take, give_up, watch, taken, answer, cue, handover, name, "
      "acknowledge, area, remove_area, judge or replay");
}

}  // namespace

ClientMessage parse_client_message(std::string_view text) {
  if (text.size() > kMostMessageBytes) return Refused{0, "the message is too long"};
  // Nesting is bounded by the size; the parser does not recurse.
  const Json message = Json::parse(text, nullptr, false);
  if (message.is_discarded()) return Refused{0, "not JSON"};
  if (!message.is_object()) return Refused{0, "not a JSON object"};
  std::int64_t number = 0;
  const auto given = message.find("number");
  if (given != message.end()) {
    if (!given->is_number_unsigned() || *given > 9'000'000'000'000'000U) {
      return Refused{0, "number must be a whole number"};
    }
    number = given->get<std::int64_t>();
  }
  try {
    return read(message, number);
  } catch (const FormError& error) {
    return Refused{number, error.what()};
  }
}

}  // namespace ols::console
