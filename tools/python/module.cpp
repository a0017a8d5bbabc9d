// The Python module `ols._core`.
#include <string>

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
  // For help(ols), which lists nothing else, and for type checkers.
  pybind11::list names;
  for (const auto& [name, value] : pybind11::dict(m.attr("__dict__"))) {
    if (!name.cast<std::string>().starts_with('_')) names.append(name);
  }
  m.attr("__all__") = names;
}
