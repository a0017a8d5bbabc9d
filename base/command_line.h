// A program's beginning and end, the same way everywhere: its command line, with one line about bad
// input and status 2, and what it prints, which must have arrived.
#pragma once

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <iostream>
#include <optional>
#include <system_error>

namespace ols {

inline constexpr int kExitBadInput = 2;

// Throws std::system_error where anything printed so far, by std::cout or stdout, was not written:
// on a full disk, for instance.
inline void flush_output() {
  errno = 0;
  std::cout.flush();
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good()) return;
  throw std::system_error(errno == 0 ? EIO : errno, std::generic_category(), "standard output");
}

// The status to end with: 0 after --help, 2 after bad input. Nothing when the program shall go on.
inline std::optional<int> parse_command_line(CLI::App& app, int argc, char** argv,
                                             const char* program) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    const int status = app.exit(help);
    try {
      flush_output();
    } catch (const std::system_error& error) {
      std::fprintf(stderr, "%s: %s\n", program, error.what());
      return kExitBadInput;
    }
    return status;
  } catch (const CLI::Error& error) {
    std::fprintf(stderr, "%s: %s\n", program, error.what());
    return kExitBadInput;
  }
  return std::nullopt;
}

}  // namespace ols
