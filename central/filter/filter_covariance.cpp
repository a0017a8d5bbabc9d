#include "central/filter/filter_covariance.h"

namespace ols::fusion {

FilterCovariance FilterCovariance::of(const Eigen::Ref<const Eigen::MatrixXd>& whole) {
  FilterCovariance result(whole.rows());
  for (Eigen::Index j = 0; j < whole.rows(); ++j)
    result.column(j) = whole.col(j).tail(whole.rows() - j);
  return result;
}

Eigen::MatrixXd FilterCovariance::square(Eigen::Index first, Eigen::Index size) const {
  Eigen::MatrixXd result(size, size);
  for (Eigen::Index j = 0; j < size; ++j) {
    result.col(j).tail(size - j) = column(first + j).head(size - j);
    result.row(j).tail(size - j) = result.col(j).tail(size - j).transpose();
  }
  return result;
}

void FilterCovariance::clear(Eigen::Index first, Eigen::Index size) {
  for (Eigen::Index j = 0; j < first; ++j) column(j).segment(first - j, size).setZero();
  for (Eigen::Index j = first; j < first + size; ++j) column(j).setZero();
}

}  // namespace ols::fusion
