// Reads the bus's messages from an LCM log, starting at any record. Skips and counts bytes that
// belong to no record, and keeps the position of the first such byte.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/bus/bus_inbox.h"

namespace ols {

// Where a message's time comes from.
enum class LogTimes {
  kTimeline,    // time never goes back; a record more than a day after its predecessor is garbage
  kAsRecorded,  // the time in the record, for a caller that orders messages by their own time
                // stamps
};

class LogReader {
 public:
  // Throws std::invalid_argument naming the file if it cannot be read, is empty or is compressed.
  explicit LogReader(const std::string& path, LogTimes times = LogTimes::kTimeline);

  // The next message on this project's channels; nullopt at the end of the file. Throws
  // std::invalid_argument naming file and position if the file cannot be read further, or if it
  // ends without a single such message.
  std::optional<BusMessage> next();
  // Call if the last message of next() cannot be decoded; damage() then counts it.
  void reject(const BusMessage& message);
  // The damage so far and its position, in words for a person; empty: no damage.
  std::string damage() const;

  // Position in the file [byte] of the next record, or of the garbage before it.
  std::uint64_t offset() const { return offset_ + begin_; }
  // Position in the file [byte] of the last message's record.
  std::uint64_t message_offset() const { return message_offset_; }
  // Continues at an earlier offset [byte]. `utime_us`: the time of the record before that offset.
  void seek(std::uint64_t offset, std::int64_t utime_us);

  std::int64_t utime_us() const { return utime_us_; }  // time of the last record; 0: no record yet
  std::uint64_t size() const { return size_; }
  std::uint64_t garbage_bytes() const { return garbage_.count; }
  bool is_cut_off() const { return is_cut_off_; }  // the last record is incomplete

 private:
  bool fill(std::size_t wanted);
  void skip(std::size_t bytes);
  std::optional<BusMessage> take(std::int64_t utime_us, BusMessage message, std::size_t bytes);
  void check_end() const;

  struct Damage {
    std::uint64_t count = 0, first = 0;  // `first`: position in the file [byte]
  };

  struct Close {
    void operator()(std::FILE* file) const { static_cast<void>(std::fclose(file)); }
  };
  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
  LogTimes times_;
  std::uint64_t size_ = 0;
  std::vector<std::uint8_t> buffer_;
  std::size_t begin_ = 0, end_ = 0;  // the part of the buffer that is not parsed yet
  std::uint64_t offset_ = 0;         // position in the file of the buffer's first byte
  std::int64_t utime_us_ = 0;
  std::uint64_t message_offset_ = 0;
  std::uint64_t records_ = 0, messages_ = 0;  // records of all channels; those on this project's
                                              // channels
  Damage garbage_, rejected_;
  std::string rejected_channel_;  // channel of the first rejected message
  bool is_cut_off_ = false;
};

}  // namespace ols
