// Converts Eigen matrices of fixed size to and from numpy arrays of float64.
//
// pybind11/eigen.h is not used, because it crashes under numpy 2: in Debian's pybind11 2.10, it
// calls CopyInto by its slot in numpy 1's table of functions. The functions used here have the same
// slots in numpy 1 and 2.
#pragma once

#include <pybind11/numpy.h>

#include <Eigen/Core>

namespace pybind11::detail {

template <int Rows, int Cols>
struct type_caster<Eigen::Matrix<double, Rows, Cols>> {
  static_assert(Rows > 0 && Cols > 0, "fixed sizes only");
  using Matrix = Eigen::Matrix<double, Rows, Cols>;
  PYBIND11_TYPE_CASTER(Matrix, const_name("numpy.ndarray"));

  bool load(handle source, bool /*convert*/) {
    const auto given = array_t<double, array::c_style | array::forcecast>::ensure(source);
    if (!given) PyErr_Clear();
    if (!given || !has_our_shape(given)) return false;
    for (int row = 0; row < Rows; ++row) {
      for (int col = 0; col < Cols; ++col) value(row, col) = given.data()[row * Cols + col];
    }
    return true;
  }

  static handle cast(const Matrix& matrix, return_value_policy policy, handle /*parent*/) {
    const Eigen::Matrix<double, Cols, Rows> row_major = matrix.transpose();
    array_t<double> copy(our_shape(), row_major.data());
    // Reading a field gives a copy. numpy must refuse to write its elements, because the field
    // would not change.
    if (policy == return_value_policy::reference_internal) {
      copy.attr("flags").attr("writeable") = false;
    }
    return copy.release();
  }

 private:
  static array::ShapeContainer our_shape() {
    return Cols == 1 ? array::ShapeContainer{Rows} : array::ShapeContainer{Rows, Cols};
  }

  static bool has_our_shape(const array& given) {
    if (Cols == 1) return given.ndim() == 1 && given.shape(0) == Rows;
    return given.ndim() == 2 && given.shape(0) == Rows && given.shape(1) == Cols;
  }
};

}  // namespace pybind11::detail
