#include "export/protobuf_log.h"

#include <google/protobuf/stubs/logging.h>

#include <atomic>
#include <string>

namespace ols::exports {
namespace {

std::atomic<std::uint64_t> warnings{0};
google::protobuf::LogHandler* said_before = nullptr;

// A fatal message ends the process, and must say why.
void count(google::protobuf::LogLevel level, const char* file, int line, const std::string& text) {
  ++warnings;
  if (level == google::protobuf::LOGLEVEL_FATAL && said_before != nullptr) {
    said_before(level, file, line, text);
  }
}

}  // namespace

void count_protobuf_warnings() {
  google::protobuf::LogHandler* const before = google::protobuf::SetLogHandler(count);
  if (before != count) said_before = before;
}

std::uint64_t protobuf_warnings() { return warnings; }

}  // namespace ols::exports
