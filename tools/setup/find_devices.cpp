#include "tools/setup/find_devices.h"

#include <algorithm>
#include <filesystem>
#include <regex>
#include <system_error>

#include "base/process/clocks.h"
#include "edge/serial/serial_port.h"
#include "tools/doctor/probe.h"

namespace ols::setup {
namespace {

namespace fs = std::filesystem;

std::string heard_on(const std::string& device, int baud) {
  constexpr double kListen_s = 1.3;  // receivers speak once a second
  serial::SerialPort port(device, baud);
  std::string heard;
  const double end_s = clock_monotonic_s() + kListen_s;
  while (clock_monotonic_s() < end_s && !is_receiver_talk(heard)) {
    heard += port.read(end_s - clock_monotonic_s());
  }
  return heard;
}

bool is_receiver(const std::string& device) {
  try {
    for (const int baud : {9600, 38400, 115200, 4800}) {
      if (is_receiver_talk(heard_on(device, baud))) return true;
    }
  } catch (const std::system_error&) {
    // Not there any more, in use, or no serial line: not ours to use.
  }
  return false;
}

}  // namespace

std::vector<std::string> devices_in(const std::string& folder, const std::string& beginning) {
  std::vector<std::string> devices;
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(folder, missing)) {
    const std::string name = entry.path().filename();
    if (name.starts_with(beginning)) devices.push_back(entry.path());
  }
  std::ranges::sort(devices);
  return devices;
}

std::vector<std::string> serial_lines() {
  for (const char* stable : {"/dev/ols", "/dev/serial/by-id"}) {
    auto lines = devices_in(stable, "");
    if (!lines.empty()) return lines;
  }
  auto lines = devices_in("/dev", "ttyUSB");
  for (const std::string& line : devices_in("/dev", "ttyACM")) lines.push_back(line);
  return lines;
}

std::vector<FoundPtu> find_ptus(const std::vector<std::string>& lines) {
  std::vector<FoundPtu> found;
  for (const std::string& line : lines) {
    ptu::PtuConfig config;
    config.device = line;
    const auto answers = doctor::ask_ptu(config);
    if (answers.baud != 0) found.push_back({line, answers.version, answers.baud});
  }
  return found;
}

std::vector<std::string> find_receivers(const std::vector<std::string>& lines) {
  std::vector<std::string> found;
  std::ranges::copy_if(lines, std::back_inserter(found), is_receiver);
  return found;
}

bool is_receiver_talk(const std::string& bytes) {
  static const std::regex kSentence(R"(\$G[A-Z]{4},[ -~]*\*[0-9A-F]{2}\r\n)");
  return bytes.find("\xb5\x62\x01") != std::string::npos || std::regex_search(bytes, kSentence);
}

}  // namespace ols::setup
