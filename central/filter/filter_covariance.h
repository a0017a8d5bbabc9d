// The covariance of a filter's state: the lower triangle, packed. Pure.
//
// Every bearing goes through the whole of it, once for each motion model, and a site's targets do
// not fit into the processor's cache: what one bearing touches must be short, and in one piece. So
// the columns of the target's nine states come first, each with all its rows, then those of the
// stations' states, each from its diagonal on.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace ols::fusion {

inline constexpr Eigen::Index kTargetStates = 9;

class FilterCovariance {
 public:
  using TargetColumns = Eigen::Matrix<double, Eigen::Dynamic, kTargetStates>;
  using Column = Eigen::Map<Eigen::VectorXd>;
  using ConstColumn = Eigen::Map<const Eigen::VectorXd>;

  // Zero, for at least the target's states.
  explicit FilterCovariance(Eigen::Index states = kTargetStates)
      : states_(states), kept_(static_cast<std::size_t>(begin_of(states, states)), 0.0) {}
  // Of the lower triangle of a whole matrix.
  static FilterCovariance of(const Eigen::Ref<const Eigen::MatrixXd>& whole);

  Eigen::Index rows() const { return states_; }
  double operator()(Eigen::Index row, Eigen::Index column) const { return kept_[at(row, column)]; }
  double& operator()(Eigen::Index row, Eigen::Index column) { return kept_[at(row, column)]; }
  // From the diagonal on.
  Column column(Eigen::Index j) { return {&(*this)(j, j), states_ - j}; }
  ConstColumn column(Eigen::Index j) const { return {&kept_[at(j, j)], states_ - j}; }
  // The target's columns. What is above the diagonal is not kept.
  Eigen::Map<TargetColumns> target() { return {kept_.data(), states_, kTargetStates}; }
  Eigen::Map<const TargetColumns> target() const { return {kept_.data(), states_, kTargetStates}; }

  // A part below the diagonal.
  template <int Rows, int Columns>
  Eigen::Matrix<double, Rows, Columns> block(Eigen::Index row, Eigen::Index column) const {
    Eigen::Matrix<double, Rows, Columns> result;
    for (Eigen::Index j = 0; j < Columns; ++j)
      result.col(j) = this->column(column + j).template segment<Rows>(row - column - j);
    return result;
  }
  // A square on the diagonal, with both triangles.
  Eigen::MatrixXd square(Eigen::Index first, Eigen::Index size) const;
  template <int Size>
  Eigen::Matrix<double, Size, Size> square(Eigen::Index first) const {
    Eigen::Matrix<double, Size, Size> result;
    for (Eigen::Index j = 0; j < Size; ++j) {
      result.col(j).tail(Size - j) = column(first + j).head(Size - j);
      result.row(j).tail(Size - j) = result.col(j).tail(Size - j).transpose();
    }
    return result;
  }
  // No variance, and no correlation with any other.
  void clear(Eigen::Index first, Eigen::Index size);
  void set_variance(Eigen::Index first, const Eigen::Ref<const Eigen::VectorXd>& variance) {
    for (Eigen::Index i = 0; i < variance.size(); ++i) (*this)(first + i, first + i) = variance(i);
  }

 private:
  // Where a column of the stations' states begins; of the one after the last: where all ends.
  static Eigen::Index begin_of(Eigen::Index column, Eigen::Index states) {
    const Eigen::Index before = column - kTargetStates;
    return kTargetStates * states + before * (states - kTargetStates) - before * (before - 1) / 2;
  }
  std::size_t at(Eigen::Index row, Eigen::Index column) const {
    const Eigen::Index place =
        column < kTargetStates ? column * states_ + row : begin_of(column, states_) + row - column;
    return static_cast<std::size_t>(place);
  }

  Eigen::Index states_;
  std::vector<double> kept_;
};

}  // namespace ols::fusion
