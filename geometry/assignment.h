// Optimal assignment of the rows of a cost matrix to its columns. Pure.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace ols {

// Assigns to each row at most one column, and to each column at most one row. The sum of the costs
// is the smallest possible. A row without a column costs `unassigned`. An infinite cost forbids a
// pair. Costs must not be negative. Returns the column of each row; -1 for a row without a column.
// Uses the Hungarian method with potentials; the time is proportional to rows^2 (rows + columns).
std::vector<int> assign(const Eigen::MatrixXd& cost, double unassigned);

// The sum of the costs of an assignment, which assign() minimises.
double cost_of(const std::vector<int>& assignment, const Eigen::MatrixXd& cost, double unassigned);

}  // namespace ols
