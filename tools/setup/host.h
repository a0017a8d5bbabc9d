// The host that ols-setup changes: files below a root, and commands.
#pragma once

#include <string>
#include <vector>

#include "tools/setup/plan.h"

namespace ols::setup {

class Host {
 public:
  // `root`: "" for this host; else a folder that holds another's files, where nothing is started.
  explicit Host(std::string root) : root_(std::move(root)) {}

  // A person's changes stay (kept_file.h). Says what became of each file. Returns the paths of
  // those that are new or changed. Throws std::system_error, std::runtime_error.
  std::vector<std::string> write(const std::vector<PlannedFile>& files) const;
  // Made with what is above it. `mode`: as of chmod.
  std::string folder(const std::string& path, unsigned mode) const;
  std::string path(const std::string& path) const { return root_ + path; }
  bool is_this_host() const { return root_.empty(); }

 private:
  std::string root_;
};

// Enables and starts these units of systemd, and lets the time services read what was written: they
// read their files at their start only. Returns the units that did not start.
std::vector<std::string> start(const std::vector<std::string>& units);

// Those of `units` that run.
std::vector<std::string> running(const std::vector<std::string>& units);

// Those of `units` that read one of the `changed` files at their start: their configuration, their
// key, the interface of the bus. Pure.
std::vector<std::string> readers(const std::vector<std::string>& units,
                                 const std::vector<std::string>& changed);

// Why a host that was set up does not work; empty if it does. `doctor`: exit status of ols-doctor.
// Pure.
std::string trouble(const std::vector<std::string>& not_started, int doctor);

// Runs a program with this one's standard streams and returns its status; -1 if it cannot be run
// (or ends with 127, which says the same).
int run(const std::vector<std::string>& command);

}  // namespace ols::setup
