#include "cue/framing.h"

#include <cstdint>

#include "export/sapient/frame.h"

namespace ols::cues {
namespace {

constexpr char kMagic = '\xbf';
constexpr std::string_view kEnd = "</event>";

}  // namespace

bool Framer::next_line(std::string& message) {
  const auto end = rest().find('\n');
  if (end == std::string_view::npos) return false;
  message = rest().substr(0, end);
  taken_ += end + 1;
  if (message.ends_with('\r')) message.pop_back();
  return true;
}

// An event may also end with "/>", but then it has no <point> and is of no use. It is joined to the
// next one, which then is malformed.
bool Framer::next_event(std::string& message) {
  const auto end = rest().find(kEnd);
  if (end == std::string_view::npos) return false;
  message = rest().substr(0, end + kEnd.size());
  taken_ += end + kEnd.size();
  return true;
}

// The magic byte, the length as a varint, the message. It is passed on in the form of a datagram.
bool Framer::next_tak_message(std::string& message) {
  const std::string_view rest = this->rest();
  std::uint64_t length = 0;
  std::size_t head = 1;
  for (unsigned shift = 0;; shift += 7, ++head) {
    if (head >= rest.size()) return false;
    const auto byte = static_cast<std::uint8_t>(rest[head]);
    length |= static_cast<std::uint64_t>(byte & 0x7FU) << shift;
    if ((byte & 0x80U) == 0) break;
    if (shift >= 28) length = kLongest_bytes + 1;
    if (length > kLongest_bytes) break;
  }
  if (length > kLongest_bytes) return refuse_overlong();
  ++head;
  if (rest.size() < head + length) return false;
  message.assign(1, kMagic).append("\x01").append(1, kMagic);
  message.append(rest, head, static_cast<std::size_t>(length));
  taken_ += head + static_cast<std::size_t>(length);
  return true;
}

bool Framer::next_sapient_message(std::string& message) {
  const auto length = exports::framed_length(rest());
  if (!length) return false;
  if (*length > kLongest_bytes) return refuse_overlong();
  if (rest().size() < exports::kFrameHead_bytes + *length) return false;
  message = rest().substr(exports::kFrameHead_bytes, *length);
  taken_ += exports::kFrameHead_bytes + *length;
  return true;
}

bool Framer::refuse_overlong() {
  ++overlong_;
  drop_rest();
  return false;
}

bool Framer::next(std::string& message) {
  if (framing_ == Framing::kSapient) return next_sapient_message(message);
  if (framing_ == Framing::kLines) return next_line(message);
  if (framing_ == Framing::kCot) {
    const auto begin = rest().find_first_not_of(" \t\r\n");
    taken_ += begin == std::string_view::npos ? rest().size() : begin;
    return rest().starts_with(kMagic) ? next_tak_message(message) : next_event(message);
  }
  if (rest().empty()) return false;
  message = rest();
  drop_rest();
  return true;
}

void Framer::drop_rest() {
  bytes_.clear();
  taken_ = 0;
}

std::vector<std::string> Framer::take(std::string_view bytes) {
  std::vector<std::string> messages;
  bytes_.append(bytes);
  for (std::string message; next(message); message.clear()) {
    if (!message.empty()) messages.push_back(std::move(message));
  }
  bytes_.erase(0, taken_);
  taken_ = 0;
  if (bytes_.size() > kLongest_bytes) {
    ++overlong_;
    drop_rest();
  }
  return messages;
}

}  // namespace ols::cues
