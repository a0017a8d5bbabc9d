#include "edge/ptu/starting.h"

#include <algorithm>

#include "edge/ptu/motion_commands.h"

namespace ols::ptu {

namespace {

constexpr double kQuiet_s = 0.06;    // silence that ends a flush
constexpr double kMaxFlush_s = 2.0;  // without such a silence
constexpr int kRetries = 2;          // of commands that were not answered

}  // namespace

PtuStarting::PtuStarting(const PtuStartOptions& options, double reply_timeout_s, Purpose purpose,
                         double time_s, PtuCounters& counters)
    : sequence_(options),
      reply_timeout_s_(reply_timeout_s),
      purpose_(purpose),
      counters_(counters) {
  flush(time_s);
}

void PtuStarting::flush(double time_s) {
  flush_ = Flush{time_s, time_s};
  asked_s_.reset();
}

void PtuStarting::bytes_came(double time_s) {
  if (flush_) flush_->last_byte_s = std::max(flush_->last_byte_s, time_s);
}

PtuStarting::Step PtuStarting::step(double time_s, double byte_s, bool emergency) {
  return flush_ ? step_flush(time_s, byte_s, emergency) : step_question(time_s);
}

PtuStarting::Step PtuStarting::step_flush(double time_s, double byte_s, bool emergency) {
  if (!flush_->sent) {
    flush_->sent = true;
    flush_->last_byte_s = time_s;
    return {emergency ? halt_request() : " "};  // ends an incomplete command in the unit's buffer
  }
  if (time_s - flush_->last_byte_s >= kQuiet_s + byte_s) {
    flush_.reset();
    return {{}, Event::kLineDropped};
  }
  if (time_s - flush_->began_s > kMaxFlush_s) return {{}, Event::kLineNotQuiet};
  return {};
}

PtuStarting::Step PtuStarting::step_question(double time_s) {
  if (sequence_.done()) return {{}, Event::kComplete};
  if (!asked_s_) {
    asked_s_ = time_s;
    ++counters_.requests;
    return {sequence_.request().bytes()};
  }
  if (time_s - *asked_s_ <= sequence_.timeout_s(reply_timeout_s_)) return {};
  ++counters_.timeouts;
  if (!answered_ || sequence_.slow() || retries_++ >= kRetries) return {{}, Event::kNoReply};
  flush(time_s);
  return {{}, Event::kLineDropped};
}

bool PtuStarting::take(const PtuReply& reply) {
  asked_s_.reset();
  answered_ = true;
  if (!reply.ok) ++counters_.errors;
  return sequence_.take(reply);
}

std::string PtuStarting::asked() const {
  std::string command = sequence_.request().bytes();
  command.pop_back();  // the delimiter
  return command;
}

}  // namespace ols::ptu
