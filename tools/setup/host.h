// The host that ols-setup changes: its files below a root folder, and commands.
#pragma once

#include <string>
#include <vector>

#include "tools/setup/plan.h"

namespace ols::setup {

class Host {
 public:
  // `root`: "" for this host; otherwise a folder with the files of another host, on which no units
  // are started.
  explicit Host(std::string root) : root_(std::move(root)) {}

  // Writes the files, but keeps a person's changes (kept_file.h). Prints what it did with each
  // file. Returns the paths of new and changed files. Throws std::system_error, std::runtime_error.
  std::vector<std::string> write(const std::vector<PlannedFile>& files) const;
  // Creates a folder and its parents; `mode`: as for chmod.
  std::string folder(const std::string& path, unsigned mode) const;
  std::string path(const std::string& path) const { return root_ + path; }
  bool is_this_host() const { return root_.empty(); }

 private:
  std::string root_;
};

// Enables and starts these systemd units. Restarts the time services, because they read their files
// only when they start. Returns the units that did not start.
std::vector<std::string> start(const std::vector<std::string>& units);

// The units of `units` that are running.
std::vector<std::string> running(const std::vector<std::string>& units);

// The units of `units` that read one of the `changed` files when they start: their configuration,
// their key, or the interface of the bus. Pure.
std::vector<std::string> readers(const std::vector<std::string>& units,
                                 const std::vector<std::string>& changed);

// Why a host does not work after its setup; empty: it works. `doctor`: exit status of ols-doctor.
// Pure.
std::string trouble(const std::vector<std::string>& not_started, int doctor);

// Runs a program with the standard streams of this program and returns its exit status; -1 if it
// cannot be run or returns 127.
int run(const std::vector<std::string>& command);

}  // namespace ols::setup
