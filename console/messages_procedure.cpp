#include "console/messages_procedure.h"

#include <array>
#include <cmath>
#include <sstream>

#include "base/bus/channel_names.h"
#include "base/bus/message_code.h"
#include "base/bus/message_stamp.h"
#include "base/text/plain_text.h"
#include "ols_msg/procedure_answer_t.hpp"
#include "ols_msg/procedure_t.hpp"

namespace ols::console {
namespace {

using M = ols_msg::procedure_t;

constexpr std::size_t kMostLines = 60, kMostChoices = 16;
constexpr double kLease_s = 3.0;

const char* state_of(std::int8_t state) {
  return word_of_code(state,
                      std::array{"running", "asking", "accepted", "kept_old", "aborted", "failed"});
}

// Null where it is not finite.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json lines_of(const std::string& text) {
  Json lines = Json::array();
  std::istringstream stream(text);
  for (std::string line; lines.size() < kMostLines && std::getline(stream, line);) {
    lines.push_back(plain_text(line));
  }
  return lines;
}

}  // namespace

std::optional<ReceivedProcedure> procedure_from(const BusMessage& message) {
  M p;
  if (!decode_of_schema(message, p) ||
      message.channel != station_channel(kProcedureChannel, p.station)) {
    return std::nullopt;
  }
  ReceivedProcedure heard;
  heard.station = p.station;
  heard.is_at_work = p.state == M::STATE_RUNNING || p.state == M::STATE_ASKING;
  heard.question = p.state == M::STATE_ASKING ? p.question : 0;
  for (const std::string& choice : p.choice) {
    if (heard.choices.size() < kMostChoices) heard.choices.push_back(plain_text(choice));
  }
  const bool has_picture = !p.jpeg.empty() && p.full_width_px > 0 && p.full_height_px > 0;
  if (has_picture) heard.jpeg.assign(p.jpeg.begin(), p.jpeg.end());
  heard.fields = {
      {"procedure", plain_text(p.procedure)},
      {"utime_us", p.utime},
      {"state", state_of(p.state)},
      {"step", plain_text(p.step)},
      {"progress", number(p.progress)},
      {"elapsed_s", std::isfinite(p.elapsed_s) ? Json(std::floor(p.elapsed_s)) : Json(nullptr)},
      {"question", heard.question},
      {"lines", lines_of(p.text)},
      {"choices", heard.choices},
      {"crosshair_px", p.has_crosshair ? Json{number(p.crosshair_px[0]), number(p.crosshair_px[1])}
                                       : Json(nullptr)},
      {"full_px", {p.full_width_px, p.full_height_px}}};
  return heard;
}

bool AnswerSender::send(LcmBus& bus, const ProcedureAnswer& answer, std::int64_t utime_us) {
  ols_msg::procedure_answer_t message{};
  stamp_message(message, utime_us, boot_id_, ++sequence_);
  message.station = answer.station;
  message.lease_s = kLease_s;
  message.question = answer.question;
  message.choice = answer.choice;
  message.has_pixel = answer.pixel_px ? 1 : 0;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    message.pixel_px[axis] = answer.pixel_px.value_or(std::array{0.0, 0.0})[axis];
    message.turn_deg[axis] = answer.turn_deg[axis];
  }
  return bus.publish(station_channel(kProcedureAnswerChannel, answer.station), message);
}

}  // namespace ols::console
