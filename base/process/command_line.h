// The common start and end of every program. Parses the command line; bad input gives one line on
// standard error and exit status 2. At the end, checks that the output was written.
#pragma once

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <exception>
#include <iostream>
#include <optional>
#include <string>
#include <system_error>

namespace ols {

inline constexpr int kExitBadInput = 2;

// Throws std::system_error if output to std::cout or stdout could not be written, for example
// because the disk is full.
inline void flush_output() {
  errno = 0;
  std::cout.flush();
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good()) return;
  throw std::system_error(errno == 0 ? EIO : errno, std::generic_category(), "standard output");
}

// A check for numbers: returns an error for NaN and infinity, otherwise an empty text. CLI::Range
// accepts NaN.
inline std::string refuse_not_finite(const std::string& text) {
  double value = 0.0;
  const bool finite = !CLI::detail::lexical_cast(text, value) || std::isfinite(value);
  return finite ? std::string() : "Value " + text + " is not a finite number";
}

inline void check_numbers(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    if (option->get_type_name().starts_with("FLOAT")) option->check(refuse_not_finite);
  }
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) {
    check_numbers(*command);
  }
}

// Returns the status with which the program should exit: 0 after --help, 2 after bad input;
// nullopt: the program should continue.
inline std::optional<int> parse_command_line(CLI::App& app, int argc, char** argv,
                                             const char* program) {
  check_numbers(app);
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

// Parses the command line, calls `act`, and returns its exit status. If anything throws an
// exception, or the output cannot be written, prints one line and returns 2.
template <class Act>
int run_command(CLI::App& app, int argc, char** argv, const char* program, Act act) {
  if (const auto status = parse_command_line(app, argc, argv, program)) return *status;
  try {
    const int status = act();
    flush_output();
    return status;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", program, error.what());
    return kExitBadInput;
  }
}

}  // namespace ols
