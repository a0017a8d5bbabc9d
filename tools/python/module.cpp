// The Python module `ols._core`.
#include "tools/python/bindings.h"

PYBIND11_MODULE(_core, m) {
  m.attr("__version__") = OLS_VERSION;
  m.doc() = "The C++ mathematics of OLS; import it as `ols`.";
  ols::python::bind_geometry(m);
  ols::python::bind_precision(m);
  ols::python::bind_stationing(m);
  ols::python::bind_central(m);
  ols::python::bind_trust(m);
  ols::python::bind_offline(m);
  ols::python::bind_recording(m);
}
