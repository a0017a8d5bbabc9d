// The answers of ols-setup: what becomes of them is a set of files that the programs can read, or
// one error that names the place. What goes into other programs' files brings no line of its own.
#include "tools/setup/answers.h"

#include <algorithm>
#include <string>

#include "base/config/toml_config.h"
#include "tests/fuzz/fuzz_input.h"
#include "tools/setup/plan.h"

namespace {

namespace setup = ols::setup;

std::ptrdiff_t lines(const std::string& text) { return std::ranges::count(text, '\n'); }

void check(const setup::Plan& plan, std::size_t neighbours) {
  for (const setup::PlannedFile& file : plan.files) {
    ols::fuzz::require(file.path.starts_with("/etc/") && file.path.find("..") == std::string::npos,
                       "files are in /etc");
    if (file.path == "/etc/ols/bus.env") ols::fuzz::require(lines(file.text) == 2, "two lines");
    if (file.path == "/etc/default/gpsd") ols::fuzz::require(lines(file.text) == 3, "three lines");
    if (file.path.ends_with("/ols-site.conf")) {
      ols::fuzz::require(lines(file.text) == 7 + static_cast<std::ptrdiff_t>(neighbours),
                         "a line a neighbour");
    }
  }
}

setup::Plan plan_of(const setup::Answers& answers) {
  return answers.is_station ? setup::plan_station(answers)
                            : setup::plan_centre(answers, {true, true});
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  setup::Answers answers;
  try {
    answers = setup::read_answers(std::string(ols::fuzz::text(data, size)), "fuzz");
  } catch (const ols::ConfigError& error) {
    ols::fuzz::require(std::string(error.what()).starts_with("fuzz"), "an error names the file");
    return 0;
  }
  // Found on the host, where the answers do not say them.
  if (!setup::has_camera(answers.values)) {
    setup::add(answers.values, "station.camera.device", "camera");
  }
  if (!setup::has_mount(answers.values)) {
    setup::add(answers.values, "station.mount.device", "/dev/ols/ptu");
  }
  check(plan_of(answers), answers.neighbours.size());
  return 0;
}
