// ols-precision: how good positions can be, before anything is measured.
#include <iostream>

#include "base/files/atomic_file.h"
#include "base/process/command_line.h"
#include "tools/offline/precision_paper_files.h"
#include "tools/offline/precision_site_files.h"

int main(int argc, char** argv) {
  ols::remove_temporary_files_on_signals();
  CLI::App app{
      "How good positions can be: the paper's precision theory, and the Cramer-Rao bound of any "
      "site. Lengths in metres, angles in degrees but where a column says rad."};
  app.set_version_flag("--version", OLS_VERSION);
  app.require_subcommand(1);
  ols::offline::add_figure3(app);
  ols::offline::add_figure4(app);
  ols::offline::add_table(app);
  ols::offline::add_map(app);
  ols::offline::add_budget(app);
  ols::offline::add_advice(app);
  ols::offline::add_coverage(app);
  ols::offline::add_vertical(app);
  try {
    if (const auto status = ols::parse_command_line(app, argc, argv, "ols-precision")) {
      return *status;
    }
    ols::flush_output();
  } catch (const std::exception& error) {
    std::cerr << "ols-precision: " << error.what() << '\n';
    return ols::kExitBadInput;
  }
  return 0;
}
