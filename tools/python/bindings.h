// Shared by the files of the Python module `ols`: one bind_... function per subject, and functions
// that make data classes.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

namespace ols::python {

namespace py = pybind11;

void bind_geometry(py::module_& m);
void bind_central(py::module_& m);
void bind_precision(py::module_& m);
void bind_stationing(py::module_& m);
void bind_trust(py::module_& m);
void bind_offline(py::module_& m);
void bind_recording(py::module_& m);

// The text Name(field=value, ...), with the fields in the order of their definition.
inline std::string fields_repr(const py::object& self, const char* name) {
  std::string text;
  const py::object property = py::module_::import("builtins").attr("property");
  for (const auto& [field, member] :
       py::type::of(self).attr("__dict__").attr("copy")().cast<py::dict>()) {
    if (!py::isinstance(member, property)) continue;
    text += (text.empty() ? "" : ", ") + py::cast<std::string>(field) + "=" +
            py::cast<std::string>(py::repr(self.attr(field)));
  }
  return name + ("(" + text + ")");
}

// Python's __reduce__ for pickle: how to construct the object again, from its settable fields. A
// class must have no other state.
inline py::tuple reduce_fields(const py::object& self) {
  py::dict fields;
  const py::object property = py::module_::import("builtins").attr("property");
  for (const auto& [field, member] :
       py::type::of(self).attr("__dict__").attr("copy")().cast<py::dict>()) {
    if (!py::isinstance(member, property) || member.attr("fset").is_none()) continue;
    fields[field] = self.attr(field);
  }
  const py::object partial = py::module_::import("functools").attr("partial");
  return py::make_tuple(partial(py::type::of(self), **fields), py::tuple());
}

// Makes a Python class of a plain struct. Its objects are constructed from keywords; fields that
// are not given keep their defaults, and an unknown field is a TypeError. The objects can be copied
// by copy.copy() and copy.deepcopy(), and pickled.
template <typename T>
py::class_<T> data_class(py::module_& m, const char* name, const char* doc) {
  py::class_<T> bound(m, name, doc);
  bound.def(py::init([bound, name](const py::kwargs& fields) {
    T value{};
    const py::object self = py::cast(&value, py::return_value_policy::reference);
    for (const auto& [field, given] : fields) {
      if (!py::hasattr(bound, field)) {
        throw py::type_error(std::string(name) + " has no field '" + py::cast<std::string>(field) +
                             "'");
      }
      py::setattr(self, field, given);
    }
    return value;
  }));
  bound.def("__repr__", [name](const py::object& self) { return fields_repr(self, name); });
  bound.def("__reduce__", &reduce_fields);
  bound.def("__copy__", [](const T& self) { return T(self); });
  bound.def("__deepcopy__", [](const T& self, const py::dict&) { return T(self); });
  return bound;
}

}  // namespace ols::python
