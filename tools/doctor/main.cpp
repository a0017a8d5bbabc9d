// ols-doctor: what works on this host, what does not, and what to do about it.
#include <spdlog/spdlog.h>

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "base/process/command_line.h"
#include "tools/doctor/bundle.h"
#include "tools/doctor/examination.h"

namespace {

constexpr int kExitDefect = 3;
constexpr const char* kConfiguration = "/etc/ols";

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Checks a station or the centre and says what to do about each fault. It disturbs no running "
      "program: it opens a station's devices only if the station is not running, and moves no PTU. "
      "Exit status: 0 ok, 1 warnings, 2 failures"};
  app.set_version_flag("--version", OLS_VERSION);
  std::vector<std::string> configs;
  std::string bundle;
  bool json = false;
  app.add_option("--config", configs, "Station's configuration; default: all of /etc/ols");
  app.add_flag("--json", json, "For programs");
  app.add_option(
      "--bundle", bundle,
      "Also write a bundle for remote support into this file (.tar.gz): findings, "
      "journal, configuration, versions, clock, the stations' statuses; without secrets");
  if (const auto status = ols::parse_command_line(app, argc, argv, "ols-doctor")) return *status;
  spdlog::set_level(spdlog::level::off);  // the drivers' messages are judged, not shown
  try {
    ols::doctor::Request request = ols::doctor::find_configurations(kConfiguration);
    if (!configs.empty()) {
      request.stations = configs;
      request.programs.clear();
    }
    const ols::doctor::Examination examination = ols::doctor::examine(request);
    const ols::doctor::Findings& findings = examination.findings;
    if (json) {
      std::printf("%s\n", ols::doctor::to_json(findings).c_str());
    } else {
      for (const auto& finding : findings) std::printf("%s\n", ols::doctor::line(finding).c_str());
    }
    ols::flush_output();
    if (!bundle.empty()) {
      ols::doctor::write_bundle(bundle,
                                {OLS_VERSION, findings, kConfiguration, examination.statuses});
    }
    return ols::doctor::exit_status(findings);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ols-doctor: %s\n", error.what());
    return kExitDefect;
  }
}
