#include "base/log_reader.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <span>
#include <stdexcept>
#include <utility>

#include "base/log_record.h"
#include "base/trust/trailer.h"

namespace ols {
namespace {

constexpr std::size_t kBufferBytes = 1 << 18;
constexpr std::int64_t kDay_us = 86'400'000'000;
constexpr const char* kOurChannels = "OLS_";

// A recorded signature is no part of the message (base/trust/trailer.h).
BusMessage message_of(const LogRecord& record) {
  const auto payload = trust::without_trailer(record.payload);
  BusMessage message{std::string(record.channel), {payload.begin(), payload.end()}, 0};
  message.trailer.assign(payload.end(), record.payload.end());
  return message;
}

}  // namespace

LogReader::LogReader(const std::string& path, LogTimes times)
    : file_(std::fopen(path.c_str(), "rbe")), times_(times), buffer_(kBufferBytes) {
  if (!file_ || ::fseeko(file_.get(), 0, SEEK_END) != 0) {
    throw std::invalid_argument(path + ": " + std::strerror(errno));
  }
  size_ = static_cast<std::uint64_t>(std::max<off_t>(::ftello(file_.get()), 0));
  if (size_ == 0) throw std::invalid_argument(path + ": is empty");
  std::rewind(file_.get());
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
  end_ += std::fread(buffer_.data() + end_, 1, buffer_.size() - end_, file_.get());
  return end_ >= wanted;
}

void LogReader::skip(std::size_t bytes) {
  garbage_bytes_ += bytes;
  begin_ += bytes;
}

std::optional<BusMessage> LogReader::take(std::int64_t utime_us, BusMessage message,
                                          std::size_t bytes) {
  const bool is_timeline = times_ == LogTimes::kTimeline;
  if (is_timeline && (utime_us < 0 || (utime_us_ != 0 && utime_us - utime_us_ > kDay_us))) {
    skip(bytes);
    return std::nullopt;
  }
  begin_ += bytes;
  utime_us_ = is_timeline ? std::max(utime_us, utime_us_) : utime_us;
  if (!message.channel.starts_with(kOurChannels)) return std::nullopt;
  message.received_utime_us = utime_us_;
  return message;
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
  return std::nullopt;
}

void LogReader::seek(std::uint64_t offset, std::int64_t utime_us) {
  if (::fseeko(file_.get(), static_cast<off_t>(std::min(offset, size_)), SEEK_SET) != 0) return;
  offset_ = std::min(offset, size_);
  begin_ = end_ = 0;
  utime_us_ = utime_us;
}

}  // namespace ols
