#include "edge/calibration/covariance_file.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "base/files/csv_rows.h"

namespace ols::calibration {
namespace {

// The first kCount parameters: all of a station, or the instrument's. The others have columns too.
template <int kCount>
class CovarianceRows {
 public:
  using Matrix = Eigen::Matrix<double, kCount, kCount>;
  static constexpr std::size_t kParameters = kCount;
  using Header = csv::Header<1 + kParameters>;
  using Row = csv::Row<1 + kParameters>;

  explicit CovarianceRows(const std::string& path) : path_(path) {
    header_.names[0] = "parameter";
    header_.required = 1 + kParameters - kLater;
    std::size_t earlier = 1, later = header_.required;
    for (std::size_t k = 0; k < kParameters; ++k) {
      column_[k] = is_later(k) ? later++ : earlier++;
      header_.names[column_[k]] = parameter_texts()[k].key;
    }
    csv::for_each_row(path, header_, [this](const Row& row) { take(row); });
    for (std::size_t k = 0; k < kParameters; ++k) {
      if (lines_[k] == 0 && !is_later(k)) fail(last_line_ + 1, k, "the row is missing");
    }
  }

  Matrix covariance() const {
    Matrix C;
    for (int i = 0; i < kCount; ++i) {
      for (int j = 0; j < kCount; ++j) {
        C(i, j) = from_file(i, from_file(j, cells_(i, j)));
      }
    }
    return C;
  }
  // By the correlations: the variances differ by many orders.
  void check() const {
    Eigen::Matrix<double, kCount, 1> scale;
    for (int i = 0; i < kCount; ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (cells_(i, i) < 0.0) fail(lines_[k], k, "the variance is negative");
      if (cells_(i, i) == 0.0 && (cells_.row(i).array() != 0.0).any()) {
        fail(lines_[k], k, "the variance is 0, and its covariances are not");
      }
      scale[i] = cells_(i, i) > 0.0 ? 1.0 / std::sqrt(cells_(i, i)) : 1.0;
    }
    Matrix R = scale.asDiagonal() * cells_ * scale.asDiagonal();
    check_symmetry(R);
    for (int i = 0; i < kCount; ++i) R(i, i) = 1.0;
    const Eigen::LDLT<Matrix> ldlt(R);
    if (ldlt.info() != Eigen::Success || !(ldlt.vectorD().minCoeff() > 0.0)) {
      throw CsvError(path_ + ":1: header: the matrix is not positive definite");
    }
  }

 private:
  // Older files lack these: they are then known exactly.
  static constexpr std::size_t kLater = 2;
  static bool is_later(std::size_t k) { return k == kK3 || k == kK4; }
  static const char* key(std::size_t k) { return parameter_texts()[k].key; }

  void take(const Row& row) {
    last_line_ = row.line();
    const std::string name = row.text(0);
    std::size_t k = 0;
    while (k < kParameters && name != key(k)) ++k;
    if (k == kParameters) return;
    if (lines_[k] != 0) fail(row.line(), k, "the row appears twice");
    lines_[k] = row.line();
    for (std::size_t l = 0; l < kParameters; ++l) {
      if (is_later(l) && !row.has_column(column_[l])) continue;
      cells_(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(l)) =
          row.template number<double>(column_[l], -1e12, 1e12);
    }
  }
  void check_symmetry(const Matrix& R) const {
    constexpr double kRounding = 1e-6;
    for (int i = 0; i < kCount; ++i) {
      for (int j = 0; j < i; ++j) {
        if (std::abs(R(i, j) - R(j, i)) < kRounding) continue;
        fail(lines_[static_cast<std::size_t>(i)], static_cast<std::size_t>(j),
             "is not symmetric: the covariance across the diagonal is another");
      }
    }
  }
  [[noreturn]] void fail(unsigned line, std::size_t parameter, const std::string& what) const {
    throw CsvError(path_ + ":" + std::to_string(line) + ": " + key(parameter) + ": " + what);
  }

  std::string path_;
  Header header_{};
  std::array<std::size_t, kParameters> column_{};  // of each parameter
  Matrix cells_ = Matrix::Zero();                  // in the units of the file
  std::array<unsigned, kParameters> lines_{};      // of the rows; 0: none yet
  unsigned last_line_ = 1;
};

}  // namespace

InstrumentMatrix read_covariance(const std::string& path) {
  const CovarianceRows<kInstrumentParameters> rows(path);
  rows.check();
  return rows.covariance();
}

StationMatrix read_station_covariance(const std::string& path) {
  const CovarianceRows<kStationParameters> rows(path);
  rows.check();
  return rows.covariance();
}

}  // namespace ols::calibration
