#include "base/trust/replay_marks.h"

#include <algorithm>
#include <sstream>

namespace ols::trust {
namespace {

// How far the sequence lies behind the newest; both may be any number.
std::uint64_t behind(std::int64_t newest, std::int64_t sequence) {
  return static_cast<std::uint64_t>(newest) - static_cast<std::uint64_t>(sequence);
}

KeyId id_from(const std::string& hex) {
  KeyId id{};
  for (std::size_t i = 0; i < id.size(); ++i) {
    id[i] = static_cast<std::uint8_t>(std::stoul(hex.substr(2 * i, 2), nullptr, 16));
  }
  return id;
}

}  // namespace

bool ReplayMarks::is_replayed(const KeyId& key, const std::string& channel,
                              const MessageHead& head) const {
  const Stream* stream = find(key, channel);
  if (stream == nullptr) return false;
  const Mark* mark = find(*stream, head.boot_id);
  if (mark == nullptr) return head.utime_us <= stream->forgotten_utime_us;
  return has(*mark, head.sequence);
}

bool ReplayMarks::is_heard(const KeyId& key, const std::string& channel,
                           const MessageHead& head) const {
  const Stream* stream = find(key, channel);
  const Mark* mark = stream == nullptr ? nullptr : find(*stream, head.boot_id);
  return mark != nullptr && has(*mark, head.sequence);
}

const ReplayMarks::Stream* ReplayMarks::find(const KeyId& key, const std::string& channel) const {
  const auto stream = streams_.find({key, channel});
  return stream == streams_.end() ? nullptr : &stream->second;
}

const ReplayMarks::Mark* ReplayMarks::find(const Stream& stream, std::int64_t boot_id) {
  const auto mark = std::ranges::find(stream.boots, boot_id, &Mark::boot_id);
  return mark == stream.boots.end() ? nullptr : &*mark;
}

bool ReplayMarks::has(const Mark& mark, std::int64_t sequence) {
  if (sequence > mark.newest) return false;
  const std::uint64_t age = behind(mark.newest, sequence);
  return age >= kWindow || (mark.heard >> age & 1U) != 0;
}

void ReplayMarks::note(const KeyId& key, const std::string& channel, const MessageHead& head) {
  Stream& stream = streams_[{key, channel}];
  auto mark = std::ranges::find(stream.boots, head.boot_id, &Mark::boot_id);
  if (mark == stream.boots.end()) {
    stream.boots.push_back({head.boot_id, head.sequence, 1, head.utime_us, ++revision_});
    return keep_few(stream);
  }
  mark->used = ++revision_;
  advance(*mark, head);
}

void ReplayMarks::advance(Mark& mark, const MessageHead& head) {
  mark.utime_us = std::max(mark.utime_us, head.utime_us);
  if (head.sequence <= mark.newest) {
    const std::uint64_t age = behind(mark.newest, head.sequence);
    if (age < kWindow) mark.heard |= std::uint64_t{1} << age;
    return;
  }
  const std::uint64_t step = behind(head.sequence, mark.newest);
  mark.heard = (step < kWindow ? mark.heard << step : 0) | 1U;
  mark.newest = head.sequence;
}

void ReplayMarks::keep_few(Stream& stream) {
  if (stream.boots.size() <= kBoots) return;
  const auto oldest = std::ranges::min_element(stream.boots, {}, &Mark::used);
  stream.forgotten_utime_us = std::max(stream.forgotten_utime_us, oldest->utime_us);
  stream.boots.erase(oldest);
}

std::string ReplayMarks::text() const {
  std::ostringstream out;
  for (const auto& [name, stream] : streams_) {
    for (const Mark& mark : stream.boots) {
      out << to_hex(name.first) << ' ' << name.second << ' ' << mark.boot_id << ' ' << mark.newest
          << ' ' << mark.heard << ' ' << mark.utime_us << ' ' << stream.forgotten_utime_us << '\n';
    }
  }
  return out.str();
}

std::size_t ReplayMarks::read(const std::string& text) {
  std::size_t bad = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string key, channel, rest;
    Mark mark;
    std::int64_t forgotten_utime_us = 0;
    words >> key >> channel >> mark.boot_id >> mark.newest >> mark.heard >> mark.utime_us >>
        forgotten_utime_us;
    const bool is_key = key.size() == 2 * sizeof(KeyId) &&
                        key.find_first_not_of("0123456789abcdef") == std::string::npos;
    if (!words || (words >> rest) || !is_key) {
      ++bad;
      continue;
    }
    mark.used = ++revision_;
    Stream& stream = streams_[{id_from(key), channel}];
    stream.forgotten_utime_us = std::max(stream.forgotten_utime_us, forgotten_utime_us);
    stream.boots.push_back(mark);
    keep_few(stream);
  }
  return bad;
}

}  // namespace ols::trust
