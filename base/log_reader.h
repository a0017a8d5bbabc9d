// Reads the bus's messages out of an LCM log, beginning at any record. Bytes that are no record are
// skipped and counted.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/bus_inbox.h"

namespace ols {

// What a message's time is taken from.
enum class LogTimes {
  kTimeline,    // never goes back; a record more than a day later than the one before is garbage
  kAsRecorded,  // whatever the record says: for who orders messages by their own stamps
};

class LogReader {
 public:
  // Throws std::invalid_argument that names the file if it cannot be read or is empty.
  explicit LogReader(const std::string& path, LogTimes times = LogTimes::kTimeline);

  // The next message of this project's channels; nothing at the end.
  std::optional<BusMessage> next();
  // Where the next record begins, or garbage before it.
  std::uint64_t offset() const { return offset_ + begin_; }
  // To an offset from before, with the time of the record before it.
  void seek(std::uint64_t offset, std::int64_t utime_us);

  std::int64_t utime_us() const { return utime_us_; }  // of the last record; 0: none yet
  std::uint64_t size() const { return size_; }
  std::uint64_t garbage_bytes() const { return garbage_bytes_; }
  bool is_cut_off() const { return is_cut_off_; }  // the last record is not whole

 private:
  bool fill(std::size_t wanted);
  void skip(std::size_t bytes);
  std::optional<BusMessage> take(std::int64_t utime_us, BusMessage message, std::size_t bytes);

  struct Close {
    void operator()(std::FILE* file) const { static_cast<void>(std::fclose(file)); }
  };
  std::unique_ptr<std::FILE, Close> file_;
  LogTimes times_;
  std::uint64_t size_ = 0;
  std::vector<std::uint8_t> buffer_;
  std::size_t begin_ = 0, end_ = 0;  // what of the buffer has not been parsed
  std::uint64_t offset_ = 0;         // of the buffer in the file
  std::int64_t utime_us_ = 0;
  std::uint64_t garbage_bytes_ = 0;
  bool is_cut_off_ = false;
};

}  // namespace ols
