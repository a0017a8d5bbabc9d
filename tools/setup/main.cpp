// ols-setup: makes a fresh computer a station or the centre of a site.
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/config/toml_config.h"
#include "base/files/atomic_file.h"
#include "base/files/small_file.h"
#include "base/process/command_line.h"
#include "tools/setup/answers.h"
#include "tools/setup/backup.h"
#include "tools/setup/chosen_devices.h"
#include "tools/setup/dialogue.h"
#include "tools/setup/host.h"
#include "tools/setup/membership.h"
#include "tools/setup/plan.h"

namespace {

namespace fs = std::filesystem;
namespace setup = ols::setup;

constexpr std::size_t kLargestAnswers = 1'000'000;
constexpr int kExitTrouble = 1;
constexpr const char* kTyped = "/var/lib/ols-setup/answers.toml";

struct Words {
  std::string answers, root, backup, restore;
  bool no_start = false;
};

// A running station holds its devices, so those of the last run are taken as they are.
void take_known_devices(const setup::Host& host, setup::Answers& answers) {
  const std::string path = host.path("/etc/ols/" + answers.station + ".toml");
  if (!fs::exists(path)) return;
  const setup::Values known = setup::flat(ols::read_small_file(path, kLargestAnswers));
  const bool camera = !setup::has_camera(answers.values);
  const bool mount = !setup::has_mount(answers.values);
  for (const auto& [key, value] : known) {
    const bool taken = (camera && key.starts_with("camera.")) ||
                       (mount && (key.starts_with("mount.") || key.starts_with("ptu.")));
    const std::string answer = "station." + key;
    if (taken && setup::find(answers.values, answer) == nullptr)
      answers.values.emplace_back(answer, value);
  }
}

// Asks until what was typed can be used.
setup::Answers ask_person(const setup::Host& host) {
  const std::string kept = host.path(kTyped);
  std::string text = fs::exists(kept) ? ols::read_small_file(kept, kLargestAnswers) : "";
  for (;;) {
    text = setup::ask_all(std::cin, std::cout, setup::flat(text), setup::not_fitting);
    try {
      const setup::Answers answers = setup::read_answers(text, "answers");
      host.folder("/var/lib/ols-setup", 0700);
      ols::AtomicFile file(kept);
      file.stream() << text;
      file.commit();
      return answers;
    } catch (const ols::ConfigError& error) {
      std::printf("\n%s\n\n", error.what());
    }
  }
}

struct Done {
  std::vector<std::string> units;    // to start
  std::vector<std::string> changed;  // files that programs read at their start
};

Done set_up(const Words& words, const setup::Host& host) {
  const bool asks = words.answers.empty();
  setup::Answers answers =
      asks ? ask_person(host)
           : setup::read_answers(ols::read_small_file(words.answers, kLargestAnswers),
                                 words.answers);
  setup::Plan plan;
  std::vector<std::string> changed, keys;
  if (answers.is_station) {
    take_known_devices(host, answers);
    setup::choose_devices(host, answers, asks);
    plan = setup::plan_station(answers);
    changed = host.write(plan.files);
    keys = setup::join_site(host, answers.station, answers.invitation);
  } else {
    plan = setup::plan_centre(answers, {fs::exists(host.path("/usr/bin/ols-fusion")),
                                        fs::exists(host.path("/usr/bin/ols-console"))});
    changed = host.write(plan.files);
    keys = setup::make_site(host, answers.site, answers.root);
  }
  changed.insert(changed.end(), keys.begin(), keys.end());
  return {plan.units, changed};
}

Done restore(const Words& words, const setup::Host& host) {
  return {setup::restore(host, words.restore), {}};
}

// A person decides when: a station that tracks would lose its target.
void say_restart(const std::vector<std::string>& units) {
  if (units.empty()) return;
  std::printf(
      "\nRunning services go on with what they read at their start, until\n"
      "  systemctl restart");
  for (const std::string& unit : units) std::printf(" %s", unit.c_str());
  std::printf("\n\n");
}

int start(const Words& words, const setup::Host& host, const Done& done) {
  const std::vector<std::string>& units = done.units;
  if (!host.is_this_host() || words.no_start) {
    std::printf("to be enabled:");
    for (const std::string& unit : units) std::printf(" %s", unit.c_str());
    std::printf("\n");
    return 0;
  }
  // A restore replaces the files of all services.
  const std::vector<std::string> running = setup::running(units);
  say_restart(words.restore.empty() ? setup::readers(running, done.changed) : running);
  const std::vector<std::string> not_started = setup::start(units);
  const std::string trouble = setup::trouble(not_started, setup::run({"ols-doctor"}));
  if (trouble.empty()) return 0;
  std::fprintf(stderr, "ols-setup: everything is written, but not all works: %s\n",
               trouble.c_str());
  return kExitTrouble;
}

int do_what_is_asked(const Words& words, const setup::Host& host) {
  if (!words.backup.empty()) {
    setup::back_up(host, words.backup);
    return 0;
  }
  return start(words, host, words.restore.empty() ? set_up(words, host) : restore(words, host));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Makes this computer a station or the centre of a site: finds its devices, writes its "
      "configuration and keys, starts its services. Asks what it cannot find, or reads it from a "
      "file. Run it again at any time: what a person has changed in /etc/ols is kept. Exit status: "
      "0 all works, 1 a service has not started or ols-doctor finds a failure, 2 bad input"};
  app.set_version_flag("--version", OLS_VERSION);
  Words words;
  app.add_option("--answers", words.answers, "TOML file with the answers (docs/setup.md)");
  app.add_option("--root", words.root,
                 "Folder that holds another computer's files; nothing is started");
  app.add_flag("--no-start", words.no_start, "Write everything, start nothing");
  auto* backup = app.add_option("--backup", words.backup,
                                "Write configuration, keys and calibrations to this file instead");
  app.add_option("--restore", words.restore, "Restore such a file instead, and start the services")
      ->excludes(backup);
  return ols::run_command(app, argc, argv, "ols-setup", [&] {
    ::umask(022);  // the services read what is no secret, whatever root's own files are to be
    if (words.root.empty() && ::geteuid() != 0) throw std::runtime_error("must run as root");
    const setup::Host host(words.root);
    return do_what_is_asked(words, host);
  });
}
