#include "sim/ptu/reply_faults.h"

namespace ols::sim {

namespace {

// The length of a reply is unknown at its begin: the error is at one of this many bytes, or at the
// last byte of a shorter reply.
constexpr int kTypicalReply_bytes = 8;

}  // namespace

void PtuReplyFaults::set(double garble_share, double lost_every_s, double time_s) {
  garble_share_ = garble_share;
  if (lost_every_s != lost_every_s_) next_loss_s_ = time_s + lost_every_s;
  lost_every_s_ = lost_every_s;
}

void PtuReplyFaults::begin_reply(double time_s) {
  within_reply_ = true;
  losing_ = lost_every_s_ > 0.0 && time_s >= next_loss_s_;
  if (losing_) {
    next_loss_s_ = time_s + lost_every_s_;
    ++lost_;
  }
  bytes_to_error_.reset();
  if (garble_share_ > 0.0 && draw() < garble_share_) {
    bytes_to_error_ = static_cast<int>(draw() * kTypicalReply_bytes);
  }
}

void PtuReplyFaults::garble(char byte, std::string& out) {
  ++garbled_;
  const int kind = static_cast<int>(3.0 * draw());
  const auto bits = static_cast<unsigned char>(byte);
  if (kind == 0) {
    out.push_back(static_cast<char>(bits ^ (1U << static_cast<unsigned>(8.0 * draw()))));
  } else if (kind == 1) {
    out.push_back(static_cast<char>(256.0 * draw()));
    out.push_back(byte);
  }
}

std::string PtuReplyFaults::pass(std::string_view bytes, double time_s) {
  std::string out;
  for (const char byte : bytes) {
    if (!within_reply_) begin_reply(time_s);
    const bool last = byte == '\n';
    within_reply_ = !last;
    if (losing_) continue;
    if (bytes_to_error_ && (last || --*bytes_to_error_ < 0)) {
      garble(byte, out);
      bytes_to_error_.reset();
    } else {
      out.push_back(byte);
    }
  }
  return out;
}

}  // namespace ols::sim
