// The whole of a benchmark's main() once its options are declared.
#pragma once

#include <cstdio>
#include <exception>
#include <string>

#include "base/process/command_line.h"

namespace ols::bench {

// Returns the exit status. An exception of `run` is printed under the app's name.
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
