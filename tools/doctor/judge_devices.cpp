#include "tools/doctor/judge_devices.h"

#include <cerrno>
#include <cstring>
#include <sstream>

#include "base/text/plain_text.h"
#include "conditions/alarms.h"
#include "conditions/printed.h"

namespace ols::doctor {
namespace {

constexpr double kLossWarning = 1e-4;  // of received packets; 0.1 % spoils half of the frames
constexpr double kLinkShare = 0.8;     // of a link's rate that a stream may take
constexpr int kEthernetMtu = 1500;
constexpr double kMega = 1e6;
constexpr double kBitsPerByte = 8.0;
constexpr double kHot_degC = 65.0;  // GT1290: operating range to 65 degC, of the housing
constexpr double kArcsecPerDegree = 3600.0;

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string axis_text(const char* name, const PtuAxisAnswers& axis) {
  if (!axis.resolution_arcsec || !axis.least || !axis.greatest) {
    return std::string(name) + " unknown";
  }
  const double degrees_per_count = *axis.resolution_arcsec / kArcsecPerDegree;
  return std::string(name) + printed(" %.1f", *axis.least * degrees_per_count) + "..." +
         printed("%.1f deg in steps of ", *axis.greatest * degrees_per_count) +
         printed("%.2f\"", *axis.resolution_arcsec);
}

Finding judge_baud(const PtuAnswers& ptu) {
  const std::string said = "ptu: answers at " + std::to_string(ptu.baud) + " baud";
  if (ptu.baud == ptu.wanted_baud || ptu.baud == ptu.wanted_line_baud) return ok(said);
  return fail(said + ", not at " + std::to_string(ptu.wanted_baud) + " or " +
                  std::to_string(ptu.wanted_line_baud),
              "write line_baud = " + std::to_string(ptu.baud) + " into [mount]");
}

Finding judge_axes(const PtuAnswers& ptu) {
  if (ptu.not_referenced) {
    return fail("ptu: no reference (\"Axis Error\")",
                "clear its whole travel of people and cables, then ols-ctl STATION home (or "
                "permanently: rehome = \"when-unreferenced\")");
  }
  const std::string words =
      "ptu: " + axis_text("pan", ptu.pan) + ", " + axis_text("tilt", ptu.tilt);
  for (const PtuAxisAnswers& axis : {ptu.pan, ptu.tilt}) {
    if (!axis.resolution_arcsec || !axis.least || !axis.greatest) {
      return fail(words, "replies are lost or garbled: check cable, ground and baud");
    }
    if (*axis.greatest <= *axis.least) {
      return fail(words, "the unit has no travel: home it (switch it off and on)");
    }
  }
  return ok(words);
}

Finding judge_supply(const PtuAnswers& ptu) {
  if (!ptu.environment)
    return warn("ptu: does not report its supply voltage", "measure the voltage at it");
  const std::string words = "ptu: supply" + printed(" %.1f V", ptu.environment->supply_V);
  if (ptu.environment->supply_V >= ptu.supply_min_V) return ok(words);
  return warn(words + ", below" + printed(" %.1f V", ptu.supply_min_V),
              "charge or replace the battery; at 12 V it reaches two thirds of its speed");
}

}  // namespace

Finding judge(const device::DeviceReport& device) {
  const std::string words = device.name + (device.text.empty() ? "" : ": " + device.text);
  switch (device.state) {
    case device::DeviceState::kOk:
      return ok(words);
    case device::DeviceState::kStarting:
      return warn(words, "starting; ask again in a minute");
    case device::DeviceState::kAbsent:
    case device::DeviceState::kFault:
      break;
  }
  const std::string trouble = device.last_error.empty() || device.last_error == device.text
                                  ? std::string()
                                  : " (" + device.last_error + ")";
  return fail(words + trouble, advice_on(device.alarms.empty() ? Alarm() : device.alarms.front()));
}

std::optional<Finding> judge_line(const std::string& name, const SerialFacts& serial) {
  const std::string words = name + ": " + serial.device;
  switch (serial.error) {
    case 0:
      if (serial.users.empty()) return std::nullopt;
      return warn(words + " is also open in " + joined(serial.users),
                  "stop that program: two readers take each other's bytes");
    case ENOENT:
    case ENODEV:
    case ENXIO:
      return fail(words + " is not there",
                  "plug the adapter in; ls -l /dev/ols /dev/serial/by-id shows what is there");
    case EACCES:
    case EPERM:
      return fail(words + ": no permission to open it",
                  "run as root or as user ols; the device must be of group dialout");
    case EAGAIN:
    case EBUSY:
      return fail(words + " is in use by " +
                      (serial.users.empty() ? "another program" : joined(serial.users)),
                  "stop that program, or stop the station to have its devices examined");
    case ENOTTY:
      return fail(words + " is not a serial line", "correct the device in the configuration");
    default:
      return fail(words + ": " + std::strerror(serial.error),
                  advice_on(name == "ptu" ? alarm::ptu_halted("") : Alarm()));
  }
}

Findings judge(const PtuAnswers& ptu) {
  Findings findings;
  if (const auto line = judge_line("ptu", ptu.serial)) {
    findings.push_back(*line);
    if (line->verdict == Verdict::kFail) return findings;
  }
  if (ptu.baud == 0) {
    findings.push_back(fail("ptu: no answer on " + ptu.serial.device + " at any rate",
                            "check its 12-30 V supply, the cable (null modem?), and whether it is "
                            "still homing after power-up (20 s)"));
    return findings;
  }
  findings.push_back(ok("ptu: " + ptu::ptu_name(ptu.version) + " on " + ptu.serial.device));
  findings.push_back(judge_baud(ptu));
  findings.push_back(judge_axes(ptu));
  findings.push_back(judge_supply(ptu));
  return findings;
}

Findings judge(const LinkFacts& link, double rate_bytes_s) {
  if (link.name.empty()) {
    return {fail("link: no route to the camera",
                 "give the interface an address in the camera's network")};
  }
  if (!link.carrier) {
    return {fail("link: " + link.name + " has no carrier", "check the cable and the switch")};
  }
  Findings findings;
  std::string words = "link: " + link.name + ", MTU " + std::to_string(link.mtu);
  if (link.speed_Mbit_s) words += ", " + std::to_string(*link.speed_Mbit_s) + " Mbit/s";
  const double wanted_Mbit_s = rate_bytes_s * kBitsPerByte / kMega;
  if (link.speed_Mbit_s && wanted_Mbit_s > kLinkShare * *link.speed_Mbit_s) {
    findings.push_back(fail(words + ", but the stream takes" + printed(" %.0f", wanted_Mbit_s),
                            "use a gigabit cable and port, or lower frame_rate_hz"));
  } else if (link.mtu < kEthernetMtu) {
    findings.push_back(warn(words, "ip link set " + link.name +
                                       " mtu 1500, or 9000 where the "
                                       "switch carries it"));
  } else {
    findings.push_back(ok(words));
  }
  const double loss = link.received == 0
                          ? 0.0
                          : static_cast<double>(link.dropped) / static_cast<double>(link.received);
  if (loss > kLossWarning) {
    findings.push_back(warn(
        "link: " + link.name + " has lost" + printed(" %.2f %%", 100.0 * loss) + " of its packets",
        "set packet_delay_us, and net.core.rmem_max by 60-ols.conf; check the "
        "cable"));
  }
  return findings;
}

Finding judge_measured_mount(const std::string& record, const std::string& station) {
  if (record.empty()) {
    return ok(
        "mount: not measured yet: ols-calibrate mount --station " + station +
        " turns it a little and shows whether it moves, how late and how exact its positions are");
  }
  std::string text = "mount: measured by ols-calibrate mount";
  std::istringstream lines(record);
  for (std::string one; std::getline(lines, one);) text += "; " + plain_text(one);
  return ok(text);
}

std::optional<Finding> judge_hosts(const std::string& of_pictures, const std::string& of_mount) {
  if (of_pictures == of_mount) return std::nullopt;
  return warn("mount: at " + of_mount + ", but the pictures come from " + of_pictures,
              "right if they come through a recorder or a proxy; else correct url in [camera] or "
              "[mount]: a stream of another camera gives wrong bearings");
}

Findings judge(const CameraAnswers& camera) {
  Findings findings;
  if (camera.controlled) {
    findings.push_back(fail("camera: " + camera.device + " is controlled by another program",
                            "stop the other program; the camera is free 3 s later"));
  } else if (!camera.trouble.empty()) {
    findings.push_back(
        fail("camera: " + camera.trouble, camera.others.empty()
                                              ? advice_on(alarm::camera_silent())
                                              : "these answer: " + joined(camera.others) +
                                                    "; write one of them as device into [camera]"));
  } else {
    findings.push_back(ok("camera: " + camera.identity + " at " + camera.device));
    if (!camera.has_clock) {
      findings.push_back(warn("camera: its clock cannot be read",
                              "frames are stamped on arrival, and bearings flagged so; set "
                              "readout_s and readout_sd_s"));
    }
    if (camera.temperature_degC && *camera.temperature_degC > kHot_degC) {
      findings.push_back(
          warn("camera:" + printed(" %.0f degC", *camera.temperature_degC), "give it shade"));
    }
  }
  if (camera.link) append(findings, judge(*camera.link, camera.rate_bytes_s));
  return findings;
}

}  // namespace ols::doctor
