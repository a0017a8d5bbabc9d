// The folder of the logs: lists the logs and removes the oldest. Logs are the files
// NAME-*.lcmlog.*; all others are ignored.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ols::logger {

struct LogFile {
  std::string path;
  double bytes = 0.0;
  std::int64_t modified_ns = 0;
};

class LogFolder {
 public:
  LogFolder(const std::string& folder, const std::string& name);

  // Lists the logs. Creates a missing folder. Throws std::system_error if the path is not a folder
  // or is not writable.
  void survey();
  // Removes the oldest logs until `headroom_bytes` more fit into the quota, and also onto the disk
  // without using its reserve. Never removes the file `keep`. Throws std::system_error if a file
  // cannot be removed.
  void remove_oldest(double quota_bytes, double reserve_bytes, double headroom_bytes,
                     const std::string& keep);

  double bytes() const;
  double free_bytes() const { return free_bytes_; }
  const std::vector<LogFile>& files() const { return files_; }  // oldest first
  std::uint64_t removed() const { return removed_; }

 private:
  void measure_room();

  std::string folder_, name_;
  std::vector<LogFile> files_;
  double free_bytes_ = 0.0;
  std::uint64_t removed_ = 0;
};

}  // namespace ols::logger
