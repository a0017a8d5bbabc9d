// Writes the data of the figures and the table in the paper's section 4 as CSV.
#pragma once

#include <CLI/CLI.hpp>

namespace ols::offline {

// Each function adds its subcommand to ols-precision; the subcommand runs as soon as it is parsed.
void add_figure3(CLI::App& app);
void add_figure4(CLI::App& app);
void add_table(CLI::App& app);

}  // namespace ols::offline
