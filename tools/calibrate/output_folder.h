// The folder of a calibration. It appears whole or not at all, and overwrites nothing.
#pragma once

#include <array>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

namespace ols::calibration {

struct OutputFile {
  std::string name;  // in the output's folder; a network has a folder for each station
  std::string text;
};

// Delays SIGINT, SIGTERM and SIGHUP while it lives, in every thread. The results are a few
// kilobytes, and a signal waits until they are written.
class SignalsWait {
 public:
  static constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};

  SignalsWait();
  ~SignalsWait();
  SignalsWait(const SignalsWait&) = delete;
  SignalsWait& operator=(const SignalsWait&) = delete;

 private:
  std::array<struct sigaction, kSignals.size()> before_{};
};

// The folder of this name, without links and without a slash at the end. Throws
// std::invalid_argument naming --output unless it is new or empty, and no interrupted run has left
// data.
std::filesystem::path checked_folder(const std::string& output);

// All files or none: the folder gets its name when all are written.
void write_folder(const std::filesystem::path& folder, const std::vector<OutputFile>& files);

}  // namespace ols::calibration
