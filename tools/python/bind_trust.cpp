// Signatures and the trust list, for Python.
#include <pybind11/stl.h>

#include "base/config/toml_config.h"
#include "base/process/clocks.h"
#include "base/trust/bus_trust.h"
#include "base/trust/channel_rules.h"
#include "tools/python/bindings.h"

namespace ols::python {
namespace {

trust::Bytes view(const py::bytes& bytes) {
  const std::string_view text = bytes;
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

std::shared_ptr<trust::BusTrust> open(const std::string& keys, const std::string& name,
                                      std::int64_t boot_id) {
  trust::Self self;
  self.name = name;
  self.boot_id = boot_id;
  self.commands = true;
  trust::Environment environment;
  environment.mode = "require";
  environment.keys = keys;
  return trust::BusTrust::open({}, environment, self);
}

py::bytes sign(trust::BusTrust& trust, const std::string& channel, const py::bytes& message) {
  const auto bytes = trust.sign(channel, view(message));
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::optional<std::string> hear(trust::BusTrust& trust, const std::string& channel,
                                const py::bytes& message) {
  const auto judged = trust.judge(channel, view(message), clock_utime_us(), clock_monotonic_s());
  if (!judged.distrust) return std::nullopt;
  return trust::to_string(*judged.distrust);
}

// Role and name of who may send there; no name: any member of that role.
std::optional<std::pair<std::string, std::string>> sender_of(const std::string& channel) {
  const auto found = trust::rule_of(channel);
  if (!found) return std::nullopt;
  const bool by_name = found->rule->sender == trust::Role::kStation;
  return std::pair{std::string(trust::to_string(found->rule->sender)),
                   by_name ? std::string(found->station) : ""};
}

}  // namespace

void bind_trust(py::module_& m) {
  py::class_<trust::BusTrust, std::shared_ptr<trust::BusTrust>>(
      m, "Trust", "A member of a site: signs and judges messages of the bus (docs/security.md).")
      .def(py::init(&open), py::arg("keys"), py::arg("name"), py::arg("boot_id"),
           "keys: a folder with NAME.key and trust.toml. ValueError if they cannot be used.")
      .def("sign", &sign, py::arg("channel"), py::arg("message"),
           "The message with its signature. A command names the boot of its station, if a status "
           "of it has been heard.")
      .def("hear", &hear, py::arg("channel"), py::arg("message"),
           "Why the message is not believed; None: it is.");
  m.def("sender_of", &sender_of, py::arg("channel"),
        "(role, name) of who may send on a channel of the bus, name \"\" for any member of that "
        "role; None for a channel of nobody.");
  py::register_exception<ConfigError>(m, "ConfigError", PyExc_ValueError);
}

}  // namespace ols::python
