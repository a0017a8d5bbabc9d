// Chooses the names of a logger's files: FOLDER/NAME-<UTC>.lcmlog.NN. Sorted names are in the order
// of time, unless UTC is set back.
#pragma once

#include <cstdint>
#include <string>

namespace ols::logger {

class LogNames {
 public:
  LogNames(std::string folder, std::string name);

  // The next unused name. Throws std::system_error if the folder cannot be read.
  std::string next(std::int64_t utime_us);

 private:
  std::string folder_, name_;
  std::string time_;  // UTC in the last name
  int number_ = 0;    // NN of the next name with this UTC
};

}  // namespace ols::logger
