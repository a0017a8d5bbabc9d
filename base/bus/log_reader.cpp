#include "base/bus/log_reader.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "base/bus/log_record.h"
#include "base/text/plain_text.h"
#include "base/trust/trailer.h"

namespace ols {
namespace {

constexpr std::size_t kBufferBytes = 1 << 18;
constexpr std::size_t kHeadBytes = 8;
constexpr std::int64_t kDay_us = 86'400'000'000;
constexpr const char* kOurChannels = "OLS_";

// A recorded signature is no part of the message (base/trust/trailer.h).
BusMessage message_of(const LogRecord& record) {
  const auto payload = trust::without_trailer(record.payload);
  BusMessage message{std::string(record.channel), {payload.begin(), payload.end()}, 0};
  message.trailer.assign(payload.end(), record.payload.end());
  return message;
}

struct Compression {
  const char* name;
  std::string_view beginning;
};
constexpr std::array kCompressions{
    Compression{"gzip", "\x1F\x8B"},        Compression{"zstd", "\x28\xB5\x2F\xFD"},
    Compression{"xz", "\xFD\x37zXZ"},       Compression{"bzip2", "BZh"},
    Compression{"lz4", "\x04\x22\x4D\x18"}, Compression{"zip", "PK\x03\x04"}};

void add_part(std::string& text, const std::string& part) {
  text += (text.empty() ? "" : "; ") + part;
}

}  // namespace

LogReader::LogReader(const std::string& path, LogTimes times)
    : path_(path), file_(std::fopen(path.c_str(), "rbe")), times_(times), buffer_(kBufferBytes) {
  if (!file_ || ::fseeko(file_.get(), 0, SEEK_END) != 0) {
    throw std::invalid_argument(path + ": " + std::strerror(errno));
  }
  size_ = static_cast<std::uint64_t>(std::max<off_t>(::ftello(file_.get()), 0));
  if (size_ == 0) throw std::invalid_argument(path + ": is empty");
  std::rewind(file_.get());
  fill(kHeadBytes);
  const std::string_view head(reinterpret_cast<const char*>(buffer_.data()), end_);
  for (const Compression& compression : kCompressions) {
    if (!head.starts_with(compression.beginning)) continue;
    throw std::invalid_argument(path + ": is compressed (" + compression.name +
                                "): decompress it first");
  }
}

// Whether that many bytes wait in the buffer now.
bool LogReader::fill(std::size_t wanted) {
  if (end_ - begin_ >= wanted) return true;
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_),
            buffer_.begin() + static_cast<std::ptrdiff_t>(end_), buffer_.begin());
  offset_ += begin_;
  end_ -= begin_;
  begin_ = 0;
  if (buffer_.size() < wanted) buffer_.resize(wanted);
  errno = 0;
  end_ += std::fread(buffer_.data() + end_, 1, buffer_.size() - end_, file_.get());
  if (std::ferror(file_.get()) != 0) {
    throw std::invalid_argument(path_ + ": byte " + std::to_string(offset_ + end_) + ": " +
                                std::strerror(errno));
  }
  return end_ >= wanted;
}

void LogReader::skip(std::size_t bytes) {
  if (garbage_.count == 0) garbage_.first = offset();
  garbage_.count += bytes;
  begin_ += bytes;
}

std::optional<BusMessage> LogReader::take(std::int64_t utime_us, BusMessage message,
                                          std::size_t bytes) {
  const bool is_timeline = times_ == LogTimes::kTimeline;
  if (is_timeline && (utime_us < 0 || (utime_us_ != 0 && utime_us - utime_us_ > kDay_us))) {
    skip(bytes);
    return std::nullopt;
  }
  message_offset_ = offset();
  begin_ += bytes;
  ++records_;
  is_cut_off_ = false;  // the previous record claimed too much, but another one follows
  utime_us_ = is_timeline ? std::max(utime_us, utime_us_) : utime_us;
  if (!message.channel.starts_with(kOurChannels)) return std::nullopt;
  message.received_utime_us = utime_us_;
  ++messages_;
  return message;
}

// A file of another kind must not pass for a log in which nothing happened.
void LogReader::check_end() const {
  if (messages_ > 0) return;
  if (records_ > 0) {
    throw std::invalid_argument(path_ + ": is an LCM log, but has no message of a site (" +
                                kOurChannels + "*)");
  }
  throw std::invalid_argument(path_ + ": is no LCM log: from byte " +
                              std::to_string(garbage_.first) + " to byte " +
                              std::to_string(offset()) + " there is no record");
}

void LogReader::reject(const BusMessage& message) {
  if (rejected_.count++ > 0) return;
  rejected_.first = message_offset_;
  rejected_channel_ = message.channel;
}

std::string LogReader::damage() const {
  std::string text;
  if (garbage_.count > 0) {
    add_part(text, std::to_string(garbage_.count) + " bytes of the log are damaged, the first is " +
                       "byte " + std::to_string(garbage_.first));
  }
  if (is_cut_off_) add_part(text, "the end is cut off");
  if (rejected_.count > 0) {
    const std::string are = rejected_.count == 1 ? " message is" : " messages are";
    add_part(text, std::to_string(rejected_.count) + are +
                       " damaged or of another version of OLS, the first, of " +
                       plain_text(rejected_channel_) + ", is at byte " +
                       std::to_string(rejected_.first));
  }
  return text;
}

std::optional<BusMessage> LogReader::next() {
  std::size_t wanted = 1;
  while (fill(wanted) || end_ > begin_) {
    const bool is_at_end = end_ - begin_ < wanted;
    const auto parsed = parse_log_record(std::span(buffer_).subspan(begin_, end_ - begin_));
    if (const auto* record = std::get_if<LogRecord>(&parsed)) {
      wanted = 1;
      auto message = take(record->utime_us, message_of(*record), record->bytes);
      if (message) return message;
    } else if (const auto* garbage = std::get_if<LogGarbage>(&parsed)) {
      wanted = 1;
      skip(garbage->bytes);
    } else if (is_at_end) {
      // A record that claims more than there is: cut off, or damaged with others behind it.
      is_cut_off_ = true;
      wanted = 1;
      skip(1);
    } else {
      wanted = std::get<LogNeedsMore>(parsed).bytes;
    }
  }
  check_end();
  return std::nullopt;
}

void LogReader::seek(std::uint64_t offset, std::int64_t utime_us) {
  if (::fseeko(file_.get(), static_cast<off_t>(std::min(offset, size_)), SEEK_SET) != 0) return;
  offset_ = std::min(offset, size_);
  begin_ = end_ = 0;
  utime_us_ = utime_us;
}

}  // namespace ols
