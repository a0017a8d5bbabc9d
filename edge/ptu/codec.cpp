#include "edge/ptu/codec.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>

namespace ols::ptu {

namespace {

constexpr std::size_t kMaxLine = 256;
constexpr std::size_t kMaxEcho = 80;

bool printable(char c) { return c >= 0x20 && c < 0x7f; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

// A value that has lost its `*` or `!`: an echo would have letters.
bool bare_value(std::string_view text) {
  return !text.empty() && text.find_first_not_of("+-.0123456789 ") == std::string_view::npos;
}

// Echoes repeat commands: letters, digits and a few signs.
bool could_be_echo(std::string_view text) {
  return text.size() <= kMaxEcho && std::all_of(text.begin(), text.end(), [](char c) {
           return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
                  std::string_view(" +-.,()@_").find(c) != std::string_view::npos;
         });
}

std::optional<double> as_number(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] =
      std::from_chars(word.data(), word.data() + word.size(), value, std::chars_format::fixed);
  const bool whole = error == std::errc{} && end == word.data() + word.size();
  return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<double> first_number(std::string_view text) {
  while (!text.empty()) {
    const std::size_t blank = std::min(text.find(' '), text.size());
    if (const auto number = as_number(text.substr(0, blank))) return number;
    text.remove_prefix(std::min(blank + 1, text.size()));
  }
  return std::nullopt;
}

}  // namespace

PtuRequest& PtuRequest::query(PtuAxis axis, PtuQuantity quantity) {
  bytes_ += {static_cast<char>(axis), static_cast<char>(quantity)};
  return finish();
}

PtuRequest& PtuRequest::set(PtuAxis axis, PtuQuantity quantity, std::int32_t value) {
  bytes_ += {static_cast<char>(axis), static_cast<char>(quantity)};
  bytes_ += std::to_string(value);
  return finish();
}

PtuRequest& PtuRequest::plain(std::string_view command) {
  bytes_ += command;
  return finish();
}

PtuRequest& PtuRequest::append(const PtuRequest& request) {
  for (const std::size_t end : request.ends_) ends_.push_back(bytes_.size() + end);
  bytes_ += request.bytes_;
  return *this;
}

PtuRequest& PtuRequest::delimiter() {
  bytes_ += ' ';
  return *this;
}

std::string_view PtuRequest::command(std::size_t index) const {
  const std::size_t begin = index == 0 ? 0 : ends_.at(index - 1);
  return std::string_view(bytes_).substr(begin, ends_.at(index) - begin);
}

PtuRequest& PtuRequest::finish() {
  bytes_ += ' ';
  ends_.push_back(bytes_.size());
  return *this;
}

std::string halt_request() {
  return " " + PtuRequest().plain("H").bytes();  // the blank ends an incomplete command
}

std::optional<std::int32_t> PtuReply::count() const {
  if (!number || std::trunc(*number) != *number) return std::nullopt;
  if (*number < std::numeric_limits<std::int32_t>::min() ||
      *number > std::numeric_limits<std::int32_t>::max()) {
    return std::nullopt;
  }
  return static_cast<std::int32_t>(*number);
}

std::vector<PtuReply> PtuReplyParser::feed(std::string_view bytes, double time_s, double byte_s) {
  std::vector<PtuReply> replies;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const char byte = bytes[i];
    const double when_s = time_s - static_cast<double>(bytes.size() - 1 - i) * byte_s;
    if (byte == '\r' || byte == '\n') {
      if (auto reply = finish_line(when_s)) replies.push_back(std::move(*reply));
      continue;
    }
    const bool star = byte == '*' && line_.find('*') == std::string::npos;
    if (star || (byte == '!' && !marked_)) {
      mark_s_ = when_s;
      marked_ = true;
    }
    if (line_.size() < kMaxLine) {
      line_.push_back(byte == '\t' ? ' ' : byte);
    } else {
      overlong_ = true;
    }
  }
  return replies;
}

void PtuReplyParser::reset() {
  without_tokens(line_);  // for their count
  line_.clear();
  overlong_ = false;
  marked_ = false;
}

std::string PtuReplyParser::without_tokens(std::string_view line) {
  std::string rest;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char next = i + 1 < line.size() ? line[i + 1] : '\0';
    const bool axis = next == 'P' || next == 'T';
    const bool limit = line[i] == '!' && axis;
    const bool other =
        (line[i] == '!' && next == 'D') || ((line[i] == '#' || line[i] == '$') && axis);
    if (limit) ++(next == 'P' ? limit_hits_.pan : limit_hits_.tilt);
    if (limit || other) {
      ++i;
    } else {
      rest.push_back(line[i]);
    }
  }
  return rest;
}

// The head of `### PAN-TILT CONTROLLER`, `### v3.3.0, (C)2010-2011 FLIR`, `Initializing...*`.
bool PtuReplyParser::is_banner(std::string_view line) {
  const bool banner = line.starts_with("###") || line.find("nitializing") != std::string_view::npos;
  banners_ += banner ? 1 : 0;
  return banner;
}

std::optional<PtuReply> PtuReplyParser::finish_line(double end_s) {
  const std::string raw = std::move(line_);
  const bool clean = !overlong_ && std::all_of(raw.begin(), raw.end(), printable);
  const double mark_s = mark_s_;
  reset();
  if (!clean) {
    ++garbled_;
    return std::nullopt;
  }
  const PtuLimitHits hits = limit_hits_;
  const std::string line = without_tokens(raw);
  if (is_banner(line)) return std::nullopt;
  const std::size_t mark = line.find_first_of("*!");
  const std::string_view before = trimmed(std::string_view(line).substr(0, mark));
  const bool single =
      mark == std::string::npos || line.find_first_of("*!", mark + 1) == std::string::npos;
  if (!could_be_echo(before) || !single || (mark == std::string::npos && bare_value(before))) {
    ++garbled_;
    return std::nullopt;
  }
  if (mark == std::string::npos) return std::nullopt;
  PtuReply reply;
  reply.ok = line[mark] == '*';
  reply.echoed = !before.empty();
  const PtuLimitHits of_line = limit_hits_ - hits;
  reply.limit_hits = static_cast<int>(of_line.pan + of_line.tilt);
  reply.text = trimmed(std::string_view(line).substr(mark + 1));
  reply.number = first_number(reply.text);
  reply.began_s = mark_s;
  reply.ended_s = end_s;
  return reply;
}

PtuComplaint complaint(std::string_view text) {
  const std::string words = lower(text);
  const auto says = [&words](const char* what) { return words.find(what) != std::string::npos; };
  if (says("allowable") && says("position")) return PtuComplaint::kPositionLimit;
  if (says("speed cannot")) return PtuComplaint::kSpeedLimit;
  if (says("axis error")) return PtuComplaint::kNotReferenced;
  if (says("illegal")) return PtuComplaint::kIllegal;
  return PtuComplaint::kOther;
}

}  // namespace ols::ptu
