// Optimal assignment of rows to columns. Pure.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace ols {

// Gives each row at most one column, and each column to at most one row, so that the sum of costs
// is least. A row without a column costs `unassigned`. An infinite cost forbids a pair. Returns the
// column of each row; -1 for a row without a column. Costs must not be negative. Uses the Hungarian
// method with potentials; the time grows with rows^2 (rows + columns).
std::vector<int> assign(const Eigen::MatrixXd& cost, double unassigned);

// The sum of costs that assign() minimises.
double cost_of(const std::vector<int>& assignment, const Eigen::MatrixXd& cost, double unassigned);

}  // namespace ols
