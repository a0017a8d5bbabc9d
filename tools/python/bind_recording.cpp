// The messages of the bus and of logs, as bytes, by the readers of the programs: neither a damaged
// log nor a hostile datagram stops them.
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "base/bus/lcm_bus.h"
#include "base/bus/log_reader.h"
#include "base/trust/trailer.h"
#include "tools/python/bindings.h"

namespace ols::python {
namespace {

using py::arg;

py::bytes bytes_of(const std::vector<std::uint8_t>& data) {
  return {reinterpret_cast<const char*>(data.data()), data.size()};
}

py::tuple tuple_of(const BusMessage& message) {
  return py::make_tuple(message.received_utime_us, message.channel, bytes_of(message.payload),
                        bytes_of(message.trailer));
}

void subscribe(LcmBus& bus, const std::string& channels, const py::function& handler,
               std::size_t messages, std::size_t bytes) {
  bus.subscribe(channels,
                [handler](const BusMessage& message) {
                  const py::gil_scoped_acquire ours;
                  handler(*tuple_of(message));
                },
                {messages, bytes});
}

// Messages that were not let in, by reason.
std::map<std::string, std::uint64_t> refused(const LcmBus& bus) {
  const BusTraffic traffic = bus.traffic();
  std::map<std::string, std::uint64_t> counts{{"fragments", traffic.fragments},
                                              {"malformed", traffic.malformed},
                                              {"overflowed", traffic.overflowed}};
  for (std::size_t i = 0; i < traffic.distrusted.size(); ++i) {
    if (traffic.distrusted.at(i) == 0) continue;
    counts[trust::to_string(static_cast<trust::Distrust>(i))] = traffic.distrusted.at(i);
  }
  return counts;
}

py::tuple split_signature(const py::bytes& message) {
  const std::string_view text = message;
  const auto* begin = reinterpret_cast<const std::uint8_t*>(text.data());
  const std::size_t payload = trust::without_trailer({begin, text.size()}).size();
  return py::make_tuple(py::bytes(text.data(), payload),
                        py::bytes(text.data() + payload, text.size() - payload));
}

py::tuple next_of(LogReader& reader) {
  const auto message = reader.next();
  if (!message) throw py::stop_iteration();
  return tuple_of(*message);
}

}  // namespace

void bind_recording(py::module_& m) {
  py::register_exception<BusError>(m, "BusError", PyExc_OSError);
  m.def("split_signature", &split_signature, arg("message"),
        "(the LCM message, its signature) of bytes as they were on the bus; without one, all of it "
        "is the message.");
  py::class_<LogReader>(m, "LogReader",
                        "The messages of an LCM log in the order of the file, each as (recorded "
                        "utime [us], channel, message, its signature). What is no record is "
                        "skipped and counted. ValueError, at the end, if the file is no log of a "
                        "site.")
      .def(py::init([](const std::string& path) {
             return std::make_unique<LogReader>(path, LogTimes::kAsRecorded);
           }),
           arg("path"),
           "ValueError that names the file if it cannot be read, is empty or compressed.")
      .def("__iter__", [](const py::object& self) { return self; })
      .def("__next__", &next_of)
      .def_property_readonly("offset", &LogReader::offset, "Where the next record begins [byte].")
      .def_property_readonly("message_offset", &LogReader::message_offset,
                             "Where the record of the last message begins [byte].")
      .def(
          "reject",
          [](LogReader& reader, const std::string& channel) {
            reader.reject({channel, {}, 0});
          },
          arg("channel"), "The last message, of this channel, is damaged: see damage.")
      .def_property_readonly("damage", &LogReader::damage,
                             "What is damaged so far and where, in words; empty: nothing.")
      .def_property_readonly("garbage_bytes", &LogReader::garbage_bytes)
      .def_property_readonly("is_cut_off", &LogReader::is_cut_off,
                             "Whether the last record is not whole.");
  py::class_<LcmBus>(m, "Bus", "The bus of a site, for who listens.")
      .def(py::init([](const std::string& url, std::shared_ptr<trust::BusTrust> member) {
             return std::make_unique<LcmBus>(url, std::move(member));
           }),
           arg("url"), arg("trust") = nullptr,
           "trust: a Trust that judges what comes; None: everything is believed. OSError, with "
           "advice, if there is no such bus.")
      .def("subscribe", &subscribe, arg("channels"), arg("handler"), arg("messages") = 100'000,
           arg("bytes") = 100'000'000,
           "handler(received utime [us], channel, message, its signature) for the channels that a "
           "regular expression names; so many wait at most, the oldest are displaced.")
      .def(
          "handle", [](LcmBus& bus, int timeout_ms) { return bus.handle(timeout_ms); },
          arg("timeout_ms"), py::call_guard<py::gil_scoped_release>(),
          "Calls the handlers of what has arrived, waiting for the first; how many there were.")
      .def_property_readonly("is_deaf", &LcmBus::is_deaf,
                             "Not even its own test message arrives any more: make another Bus.")
      .def("refused", &refused, "{reason: messages that were not let in}");
}

}  // namespace ols::python
