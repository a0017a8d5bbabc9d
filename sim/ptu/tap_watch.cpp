#include "sim/ptu/tap_watch.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "geometry/angles.h"

namespace ols::sim {

namespace {

// Longer than any master waits for an answer; a reset takes longer, but contains no positions.
constexpr double kPatience_s = 1.0;

constexpr double kTimely_s = 1e-3;        // max delay of reading a byte
constexpr double kGain = 0.1;             // of the average of latencies
constexpr std::size_t kAround_bytes = 3;  // of a reply besides its number: blank, CR, LF

mount::AngleHistory::Config history_config() {
  mount::AngleHistory::Config config;
  config.span_s = 3.0;
  return config;
}

// "PP", "TR" and the like.
bool asks_for(std::string_view command, char what) {
  return command.size() == 2 && (command[0] == 'P' || command[0] == 'T') && command[1] == what;
}

int axis_of(std::string_view command) { return command[0] == 'P' ? 0 : 1; }

// Whether a query of this name is answered with a number; other commands may not be answered.
bool wants_number(std::string_view command) {
  return command.size() == 2 && (command[0] == 'P' || command[0] == 'T') &&
         std::string_view("PORNXSDABUL").find(command[1]) != std::string_view::npos;
}

bool sets(std::string_view command) {
  return command.size() > 2 && (command[0] == 'P' || command[0] == 'T');
}

}  // namespace

PtuTapWatch::PtuTapWatch(double step_rad)
    : step_rad_{step_rad, step_rad},
      history_{mount::AngleHistory(history_config()), mount::AngleHistory(history_config())} {}

void PtuTapWatch::master_said(std::string_view bytes, double time_s, double byte_s) {
  const bool given_up = !asked_.empty() && time_s - asked_.front().sent_s > kPatience_s;
  if (given_up) drop_questions();
  for (const char byte : bytes) {
    line_free_s_ = std::max(line_free_s_, time_s) + byte_s;
    if (byte != ' ' && byte != '\r' && byte != '\n') {
      begun_.push_back(static_cast<char>(std::toupper(static_cast<unsigned char>(byte))));
      continue;
    }
    if (!begun_.empty()) asked_.push_back({begun_, line_free_s_});
    begun_.clear();
  }
}

void PtuTapWatch::unit_said(std::string_view bytes, double time_s, double byte_s) {
  for (const ptu::PtuReply& reply : parser_.feed(bytes, time_s, byte_s)) take(reply, byte_s);
}

void PtuTapWatch::interrupted() {
  parser_.reset();
  begun_.clear();
  drop_questions();
}

void PtuTapWatch::drop_questions() {
  asked_.clear();
  taken_.clear();
}

// Replies come in the order of the commands. After a lost one, a later reply is of the wrong kind;
// no reading of that burst of commands is then used.
void PtuTapWatch::take(const ptu::PtuReply& reply, double byte_s) {
  if (asked_.empty()) return;
  const Asked asked = asked_.front();
  asked_.pop_front();
  const bool fits = !reply.ok || (wants_number(asked.command) ? reply.number.has_value()
                                  : sets(asked.command)       ? reply.text.empty()
                                                              : true);
  if (!fits) {
    ++counters_.mismatched;
    drop_questions();
    return;
  }
  if (reply.ok && asks_for(asked.command, 'P')) read(axis_of(asked.command), asked, reply, byte_s);
  if (reply.ok && asks_for(asked.command, 'R')) {
    step_rad_[static_cast<std::size_t>(axis_of(asked.command))] = radians(*reply.number / 3600.0);
  }
  last_reply_s_ = reply.began_s;
  line_until_s_ = reply.began_s + static_cast<double>(reply.text.size() + kAround_bytes) * byte_s;
  if (!asked_.empty()) return;
  for (const Reading& reading : taken_) {
    counters_.readings += history_[static_cast<std::size_t>(reading.axis)].add(reading.sample);
  }
  taken_.clear();
}

// The unit read its counter between the end of the query, or of the answer before, and the begin of
// its answer. If the answer had to wait for the one before, the interval is too long to be useful:
// then the usual latency is assumed.
void PtuTapWatch::read(int axis, const Asked& asked, const ptu::PtuReply& reply, double byte_s) {
  const auto counts = reply.count();
  if (!counts) return;
  const double earliest_s = std::max(asked.sent_s, last_reply_s_);
  const double latest_s = std::max(earliest_s, reply.began_s - byte_s);
  const bool waited = latest_s < line_until_s_ + byte_s + kTimely_s;
  if (!waited) usual_s_ += kGain * (latest_s - earliest_s - usual_s_);
  const double latency_s =
      waited ? std::min(usual_s_, latest_s - earliest_s) : latest_s - earliest_s;
  mount::AngleSample sample;
  sample.time_s = earliest_s + 0.5 * latency_s;
  sample.time_sd_s = latency_s / std::sqrt(12.0);
  const double angle_rad = *counts * step_rad_[static_cast<std::size_t>(axis)];
  sample.angles = {angle_rad, angle_rad};
  taken_.push_back({axis, sample});
}

double PtuTapWatch::known_until_s() const {
  const auto pan = history_[0].newest(), tilt = history_[1].newest();
  return pan && tilt ? std::min(pan->time_s, tilt->time_s) : -1e9;
}

PanTilt PtuTapWatch::at(double time_s) const {
  const auto angle = [time_s](const mount::AngleHistory& history, double PanTilt::*axis) {
    if (const auto known = history.at(time_s)) return known->angles.*axis;
    const auto newest = history.newest();
    return newest ? newest->angles.*axis : 0.0;
  };
  return {angle(history_[0], &PanTilt::pan_rad), angle(history_[1], &PanTilt::tilt_rad)};
}

}  // namespace ols::sim
