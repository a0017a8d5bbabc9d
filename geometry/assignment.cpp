#include "geometry/assignment.h"

#include <limits>

namespace ols {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

// Shortest augmenting paths. Each row has a last column of its own, which stands for no column.
class Matching {
 public:
  Matching(const Eigen::MatrixXd& cost, double unassigned)
      : cost_(cost),
        unassigned_(unassigned),
        rows_(static_cast<int>(cost.rows())),
        columns_(static_cast<int>(cost.cols()) + rows_),
        of_row_(static_cast<std::size_t>(rows_), 0.0),
        of_column_(static_cast<std::size_t>(columns_) + 1, 0.0),
        row_(static_cast<std::size_t>(columns_) + 1, -1) {}

  // Adds a row by the path of least reduced cost to a free column.
  void add(int row) {
    const int start = columns_;  // a column beyond the last one
    row_[index(start)] = row;
    std::vector<double> least(index(columns_), kNever);
    std::vector<int> before(index(columns_), start);
    std::vector<bool> done(index(columns_) + 1, false);
    int column = start;
    while (row_[index(column)] >= 0) {
      done[index(column)] = true;
      const int next = nearest(column, done, least, before);
      const double step = least[index(next)];
      for (int j = 0; j <= columns_; ++j) {
        if (done[index(j)]) {
          of_row_[index(row_[index(j)])] += step;
          of_column_[index(j)] -= step;
        } else {
          least[index(j)] -= step;
        }
      }
      column = next;
    }
    for (; column != start; column = before[index(column)])
      row_[index(column)] = row_[index(before[index(column)])];
    row_[index(start)] = -1;
  }

  std::vector<int> columns() const {
    std::vector<int> found(index(rows_), -1);
    for (int j = 0; j < columns_ - rows_; ++j) {
      if (row_[index(j)] >= 0) found[index(row_[index(j)])] = j;
    }
    return found;
  }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  double at(int row, int column) const {
    if (column < cost_.cols()) return cost_(row, column);
    return column == cost_.cols() + row ? unassigned_ : kNever;
  }

  // The open column of least reduced cost, with the paths through `column` taken in.
  int nearest(int column, const std::vector<bool>& done, std::vector<double>& least,
              std::vector<int>& before) const {
    const int row = row_[index(column)];
    int best = -1;
    for (int j = 0; j < columns_; ++j) {
      if (done[index(j)]) continue;
      const double reduced = at(row, j) - of_row_[index(row)] - of_column_[index(j)];
      if (reduced < least[index(j)]) {
        least[index(j)] = reduced;
        before[index(j)] = column;
      }
      if (best < 0 || least[index(j)] < least[index(best)]) best = j;
    }
    return best;
  }

  const Eigen::MatrixXd& cost_;
  double unassigned_;
  int rows_, columns_;
  std::vector<double> of_row_, of_column_;  // potentials
  std::vector<int> row_;                    // of each column; -1: free
};

}  // namespace

std::vector<int> assign(const Eigen::MatrixXd& cost, double unassigned) {
  Matching matching(cost, unassigned);
  for (int row = 0; row < cost.rows(); ++row) matching.add(row);
  return matching.columns();
}

double cost_of(const std::vector<int>& assignment, const Eigen::MatrixXd& cost, double unassigned) {
  double sum = 0.0;
  for (std::size_t row = 0; row < assignment.size(); ++row) {
    const int column = assignment[row];
    sum += column < 0 ? unassigned : cost(static_cast<Eigen::Index>(row), column);
  }
  return sum;
}

}  // namespace ols
