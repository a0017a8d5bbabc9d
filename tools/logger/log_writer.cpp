#include "tools/logger/log_writer.h"

#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <vector>

namespace ols::logger {
namespace {

// The header of an event: sync word, number, stamp, two lengths.
constexpr std::uint64_t kEventHeader = 28;

std::system_error file_error(const std::string& path) {
  return {errno == 0 ? EIO : errno, std::generic_category(), path};
}

lcm_eventlog_t* create(const std::string& path) {
  std::error_code none;
  if (std::filesystem::symlink_status(path, none).type() != std::filesystem::file_type::not_found) {
    throw std::system_error(EEXIST, std::generic_category(), path);
  }
  errno = 0;
  lcm_eventlog_t* const log = lcm_eventlog_create(path.c_str(), "w");
  if (log == nullptr) throw file_error(path);
  return log;
}

}  // namespace

LogWriter::LogWriter(const std::string& path) : path_(path), log_(create(path)) {}

void LogWriter::write(const BusMessage& message) {
  lcm_eventlog_event_t event{};
  event.timestamp = message.received_utime_us;
  event.channellen = static_cast<std::int32_t>(message.channel.size());
  // With the signature, so that the log can be verified later.
  std::vector<std::uint8_t> bytes = message.payload;
  bytes.insert(bytes.end(), message.trailer.begin(), message.trailer.end());
  event.datalen = static_cast<std::int32_t>(bytes.size());
  // LCM only reads the name.
  event.channel = const_cast<char*>(message.channel.c_str());
  event.data = bytes.data();
  errno = 0;
  if (lcm_eventlog_write_event(log_.get(), &event) != 0) throw file_error(path_);
  bytes_ += kEventHeader + message.channel.size() + bytes.size();
}

void LogWriter::flush() {
  errno = 0;
  if (std::fflush(log_->f) != 0) throw file_error(path_);
}

bool LogWriter::is_in_place() const {
  struct stat written {
  }, named{};
  return ::fstat(::fileno(log_->f), &written) == 0 && ::lstat(path_.c_str(), &named) == 0 &&
         written.st_ino == named.st_ino && written.st_dev == named.st_dev;
}

}  // namespace ols::logger
