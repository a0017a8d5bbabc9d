// Reads the bus's messages out of an LCM log, beginning at any record. Bytes that are no record are
// skipped and counted, and the place of the first is kept.
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
  // Throws std::invalid_argument that names the file if it cannot be read, is empty or compressed.
  explicit LogReader(const std::string& path, LogTimes times = LogTimes::kTimeline);

  // The next message of this project's channels; nothing at the end. Throws std::invalid_argument
  // that names the file and the place if the disk fails, or at the end if the file had no such
  // message at all.
  std::optional<BusMessage> next();
  // Its reader does not understand the message that next() gave last: it is counted in damage().
  void reject(const BusMessage& message);
  // What is damaged so far and where, in words for a person; empty: nothing.
  std::string damage() const;

  // Where the next record begins, or garbage before it.
  std::uint64_t offset() const { return offset_ + begin_; }
  // Where the record of the last message begins.
  std::uint64_t message_offset() const { return message_offset_; }
  // To an offset from before, with the time of the record before it.
  void seek(std::uint64_t offset, std::int64_t utime_us);

  std::int64_t utime_us() const { return utime_us_; }  // of the last record; 0: none yet
  std::uint64_t size() const { return size_; }
  std::uint64_t garbage_bytes() const { return garbage_.count; }
  bool is_cut_off() const { return is_cut_off_; }  // the last record is not whole

 private:
  bool fill(std::size_t wanted);
  void skip(std::size_t bytes);
  std::optional<BusMessage> take(std::int64_t utime_us, BusMessage message, std::size_t bytes);
  void check_end() const;

  struct Damage {
    std::uint64_t count = 0, first = 0;  // `first`: its place in the file [byte]
  };

  struct Close {
    void operator()(std::FILE* file) const { static_cast<void>(std::fclose(file)); }
  };
  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
  LogTimes times_;
  std::uint64_t size_ = 0;
  std::vector<std::uint8_t> buffer_;
  std::size_t begin_ = 0, end_ = 0;  // what of the buffer has not been parsed
  std::uint64_t offset_ = 0;         // of the buffer in the file
  std::int64_t utime_us_ = 0;
  std::uint64_t message_offset_ = 0;
  std::uint64_t records_ = 0, messages_ = 0;  // of anybody; of this project's channels
  Damage garbage_, rejected_;
  std::string rejected_channel_;  // of the first
  bool is_cut_off_ = false;
};

}  // namespace ols
