#include "tools/setup/find_heads.h"

#include <fmt/format.h>

#include <array>
#include <memory>
#include <system_error>

#include "base/config/toml_text.h"
#include "base/process/clocks.h"
#include "edge/mount/serial/pelco_d.h"
#include "edge/mount/serial/visca_head.h"
#include "edge/serial/serial_port.h"

namespace ols::setup {
namespace {

using serial_mount::Language;

std::unique_ptr<serial_mount::LineProtocol> protocol_of(Language language, int address) {
  if (language == Language::kVisca) return std::make_unique<serial_mount::ViscaHead>();
  return std::make_unique<serial_mount::PelcoD>(address);
}

// Whether the head answers each question.
bool answers(serial::SerialPort& port, serial_mount::LineProtocol& head) {
  constexpr double kReply_s = 0.3;
  for (const std::string& question : head.questions()) {
    port.write(question);
    const double end_s = clock_monotonic_s() + kReply_s;
    const auto before = head.position();
    const auto has_news = [&] {
      const auto& now = head.position();
      return now.pan.has_value() != before.pan.has_value() ||
             now.tilt.has_value() != before.tilt.has_value();
    };
    while (!has_news()) {
      const double left_s = end_s - clock_monotonic_s();
      if (left_s <= 0.0) return false;
      head.receive(port.read(left_s));
    }
  }
  return head.position().pan && head.position().tilt;
}

int rate_of(const std::string& line, Language language, int address) {
  try {
    for (const int baud : {9600, 2400, 4800, 38400, 19200}) {
      serial::SerialPort port(line, baud);
      // Twice: the first question may end what the head takes for the beginning of a message.
      for (int attempt = 0; attempt < 2; ++attempt)
        if (answers(port, *protocol_of(language, address))) return baud;
    }
  } catch (const std::system_error&) {
    // Not there any more, in use, or no serial line: not ours to use.
  }
  return 0;
}

}  // namespace

std::vector<FoundHead> find_heads(const std::vector<std::string>& lines, Language language,
                                  int pelco_address) {
  std::vector<FoundHead> found;
  for (const std::string& line : lines) {
    if (const int baud = rate_of(line, language, pelco_address))
      found.push_back({line, language, baud, pelco_address});
  }
  return found;
}

// Pelco-D reports degrees, and pan grows to the right. With VISCA a count is 1/14.4 degree at many
// cameras, among them Sony's EVI-D100.
Found found_head(const FoundHead& head) {
  const bool is_visca = head.language == Language::kVisca;
  Found found;
  found.words = fmt::format("{} head on {} at {} baud", is_visca ? "VISCA" : "Pelco-D", head.device,
                            head.baud);
  found.values = {{"station.mount.kind", toml_text(is_visca ? "visca" : "pelco-d")},
                  {"station.mount.device", toml_text(head.device)},
                  {"station.mount.baud", fmt::format("{}", head.baud)},
                  {"station.mount.pan_gain_deg", is_visca ? "-0.0694" : "-1"},
                  {"station.mount.tilt_gain_deg", is_visca ? "0.0694" : "1"},
                  {"station.mount.pan_speed_deg_s", is_visca ? "100" : "40"},
                  {"station.mount.tilt_speed_deg_s", is_visca ? "70" : "20"}};
  if (!is_visca)
    found.values.emplace_back("station.mount.address", fmt::format("{}", head.address));
  return found;
}

}  // namespace ols::setup
