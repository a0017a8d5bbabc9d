// The folder of a calibration: it appears whole or not at all, and overwrites nothing.
#pragma once

#include <array>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

namespace ols::calibration {

struct OutputFile {
  std::string name;  // within the output's folder; a network's stations have a folder each
  std::string text;
};

// SIGINT, SIGTERM and SIGHUP wait while it lives, whichever thread they reach. The results are of a
// few kilobytes: a signal waits until they are there.
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

// The folder of this name, without links and a slash at the end. std::invalid_argument, naming
// --output, unless it is new or empty and no interrupted run has left something.
std::filesystem::path checked_folder(const std::string& output);

// All of them or none: the folder gets its name when all are written.
void write_folder(const std::filesystem::path& folder, const std::vector<OutputFile>& files);

}  // namespace ols::calibration
