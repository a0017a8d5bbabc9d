// The main() of a benchmark, after its options have been declared.
#pragma once

#include <cstdio>
#include <exception>
#include <string>

#include "base/process/command_line.h"

namespace ols::bench {

// Parses the command line and calls `run`; returns the exit status. Prints an exception of `run`
// with the app's name.
int run_program(CLI::App& app, int argc, char** argv, const auto& run) {
  const std::string name = app.get_name();
  if (const auto status = parse_command_line(app, argc, argv, name.c_str())) return *status;
  try {
    run();
    flush_output();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name.c_str(), error.what());
    return kExitBadInput;
  }
  return 0;
}

}  // namespace ols::bench
