// Computes the precision of a site: a map of the covariance, the error budget of one place, advice
// on where to put stations, and what stations see over the land.
#pragma once

#include <CLI/CLI.hpp>

namespace ols::offline {

// Each function adds its subcommand to ols-precision; the subcommand runs as soon as it is parsed.
void add_map(CLI::App& app);
void add_budget(CLI::App& app);
void add_advice(CLI::App& app);
void add_coverage(CLI::App& app);
void add_vertical(CLI::App& app);

}  // namespace ols::offline
