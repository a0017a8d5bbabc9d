// Reads a program's command line the same way everywhere: one line about bad input, status 2.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdio>
#include <optional>

namespace ols {

inline constexpr int kExitBadInput = 2;

// The status to end with: 0 after --help, 2 after bad input. Nothing when the program shall go on.
inline std::optional<int> parse_command_line(CLI::App& app, int argc, char** argv,
                                             const char* program) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::Error& error) {
    std::fprintf(stderr, "%s: %s\n", program, error.what());
    return kExitBadInput;
  }
  return std::nullopt;
}

}  // namespace ols
