// Looks at the serial lines for ols-doctor: who has them open, what the PTU answers.
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "base/process/clocks.h"
#include "edge/ptu/codec.h"
#include "edge/ptu/unit_model.h"
#include "edge/serial/serial_port.h"
#include "tools/doctor/probe.h"

namespace ols::doctor {
namespace {

namespace fs = std::filesystem;

constexpr double kReply_s = 0.6;
constexpr int kTries = 2;

// Other processes that have it open; visible only to root and their owner.
std::vector<std::string> users_of(const std::string& device) {
  std::vector<std::string> users;
  std::error_code ignored;
  const fs::path target = fs::canonical(device, ignored);
  if (ignored) return users;
  for (const auto& process : fs::directory_iterator("/proc", ignored)) {
    const std::string pid = process.path().filename();
    if (pid.find_first_not_of("0123456789") != std::string::npos) continue;
    if (pid == std::to_string(getpid())) continue;
    std::error_code denied;
    fs::directory_iterator open_files(process.path() / "fd", denied);
    if (denied) continue;
    for (const auto& file : open_files) {
      std::error_code vanished;
      if (fs::read_symlink(file.path(), vanished) != target || vanished) continue;
      std::string name;
      std::getline(std::ifstream(process.path() / "comm"), name);
      users.push_back(name + " (" + pid + ")");
      break;
    }
  }
  return users;
}

// One request at a time: the reply belongs to it.
class Questions {
 public:
  Questions(const std::string& device, int baud) : port_(device, baud) {
    port_.write(ptu::PtuRequest().delimiter().bytes());
  }

  std::optional<ptu::PtuReply> ask(const ptu::PtuRequest& request) {
    for (int attempt = 0; attempt < kTries; ++attempt) {
      while (!port_.read(0.0).empty()) {
      }
      ptu::PtuReplyParser parser;
      port_.write(request.bytes());
      const double end_s = clock_monotonic_s() + kReply_s;
      while (clock_monotonic_s() < end_s) {
        const auto replies = parser.feed(port_.read(end_s - clock_monotonic_s()));
        if (!replies.empty()) return replies.front();
      }
    }
    return std::nullopt;
  }

 private:
  serial::SerialPort port_;
};

std::optional<double> ask_number(Questions& unit, ptu::PtuAxis axis, ptu::PtuQuantity quantity,
                                 PtuAnswers& answers) {
  const auto reply = unit.ask(ptu::PtuRequest().query(axis, quantity));
  if (!reply) return std::nullopt;
  if (ptu::complaint(reply->text) == ptu::PtuComplaint::kNotReferenced)
    answers.not_referenced = true;
  return reply->ok ? reply->number : std::nullopt;
}

void ask_axis(Questions& unit, ptu::PtuAxis axis, PtuAxisAnswers& facts, PtuAnswers& answers) {
  facts.resolution_arcsec = ask_number(unit, axis, ptu::PtuQuantity::kResolution, answers);
  facts.least = ask_number(unit, axis, ptu::PtuQuantity::kMinPosition, answers);
  facts.greatest = ask_number(unit, axis, ptu::PtuQuantity::kMaxPosition, answers);
}

bool ask_at(int baud, PtuAnswers& answers) {
  Questions unit(answers.serial.device, baud);
  const auto version = unit.ask(ptu::PtuRequest().plain("V"));
  if (!version || !version->ok || version->text.empty()) return false;
  answers.baud = baud;
  answers.version = version->text;
  ask_axis(unit, ptu::PtuAxis::kPan, answers.pan, answers);
  ask_axis(unit, ptu::PtuAxis::kTilt, answers.tilt, answers);
  if (const auto supply = unit.ask(ptu::PtuRequest().plain("O"))) {
    answers.environment = ptu::ptu_environment(supply->text);
  }
  return true;
}

}  // namespace

SerialFacts look_at_line(const std::string& device, int baud) {
  SerialFacts facts;
  facts.device = device;
  facts.users = users_of(device);
  try {
    const serial::SerialPort port(device, baud);
  } catch (const std::system_error& trouble) {
    facts.error = trouble.code().value();
  }
  return facts;
}

PtuAnswers ask_ptu(const ptu::PtuConfig& config) {
  PtuAnswers answers;
  answers.serial = look_at_line(config.device, config.baud);
  answers.wanted_baud = config.baud;
  answers.wanted_line_baud = config.line_baud;
  answers.supply_min_V = config.supply_min_V;
  if (answers.serial.error != 0) return answers;
  std::vector<int> rates{config.baud};
  for (const int baud : {config.line_baud, 9600, 38400, 19200, 57600, 115200}) {
    if (std::find(rates.begin(), rates.end(), baud) == rates.end()) rates.push_back(baud);
  }
  try {
    for (const int baud : rates) {
      if (ask_at(baud, answers)) break;
    }
  } catch (const std::system_error& trouble) {
    answers.serial.error = trouble.code().value();
  }
  return answers;
}

}  // namespace ols::doctor
