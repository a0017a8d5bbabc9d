// The fields of an event say more than a place in the source.
#define SD_JOURNAL_SUPPRESS_LOCATION
#include "base/journal/journal.h"

#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <systemd/sd-journal.h>
#include <unistd.h>

#include <cstdlib>
#include <vector>

namespace ols {
namespace {

// Whoever started the program may have redirected the standard error that systemd provided.
bool is_stderr_the_journal() {
  const char* stream = std::getenv("JOURNAL_STREAM");
  struct stat file {};
  return stream != nullptr && ::fstat(STDERR_FILENO, &file) == 0 &&
         names_stream(stream, file.st_dev, file.st_ino);
}

bool send(const std::vector<std::string>& fields) {
  std::vector<iovec> parts;
  for (const std::string& field : fields) {
    parts.push_back({const_cast<char*>(field.data()), field.size()});
  }
  return sd_journal_sendv(parts.data(), static_cast<int>(parts.size())) >= 0;
}

}  // namespace

bool names_stream(const std::string& journal_stream, std::uint64_t device, std::uint64_t inode) {
  return journal_stream == std::to_string(device) + ":" + std::to_string(inode);
}

void write_to_journal(const JournalEvent& event) {
  static const bool is_journal = is_stderr_the_journal();
  if (is_journal && send(journal_fields(event))) return;
  spdlog::log(event.bad ? spdlog::level::warn : spdlog::level::info, "{}", event.text);
}

}  // namespace ols
