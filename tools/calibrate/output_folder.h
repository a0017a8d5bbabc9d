// Writes the folder of a calibration: all of it or nothing, and never over existing files.
#pragma once

#include <array>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

namespace ols::calibration {

struct OutputFile {
  std::string name;  // path in the output folder; a network has a subfolder for each station
  std::string text;
};

// While this object lives, SIGINT, SIGTERM and SIGHUP are delayed, in every thread. This protects
// the writing of the results, which are only a few kilobytes.
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

// The path of the output folder, without links and without a slash at the end. Throws
// std::invalid_argument naming --output if the folder is not empty, or if an interrupted run has
// left data there.
std::filesystem::path checked_folder(const std::string& output);

// Writes all files or none: the folder gets its name when all files are written.
void write_folder(const std::filesystem::path& folder, const std::vector<OutputFile>& files);

}  // namespace ols::calibration
