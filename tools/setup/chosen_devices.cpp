#include "tools/setup/chosen_devices.h"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <stdexcept>
#include <vector>

#include "base/config/toml_text.h"
#include "base/text/plain_text.h"
#include "edge/config/device_kinds.h"
#include "edge/device/password_file.h"
#include "tools/doctor/probe.h"
#include "tools/setup/dialogue.h"
#include "tools/setup/find_devices.h"
#include "tools/setup/find_onvif.h"
#include "tools/setup/onvif_answers.h"
#include "tools/setup/plan.h"

namespace ols::setup {
namespace {

// The only one that is found. A person chooses among several, or names one if none answers.
std::string one_of(const std::vector<std::string>& found, const std::string& what,
                   const std::string& key, bool asks) {
  if (found.empty() && asks) {
    return ask_text(std::cin, std::cout, "No " + what + " answers. What is to be " + key + "?");
  }
  if (found.empty()) throw std::runtime_error("no " + what + " answers: state " + key);
  if (found.size() == 1) return found.front();
  if (asks) return ask_which(std::cin, std::cout, "Which " + what + "?", found);
  std::string all;
  for (const std::string& one : found) all += "\n  " + one;
  throw std::runtime_error("several " + what + "s answer: choose one by " + key + all);
}

// Of several streams, a person chooses; a file names one by its profile, otherwise the first that
// turns the camera is taken.
const onvif::Offer::Stream& one_stream(const onvif::Offer& offer, const Values& values, bool asks) {
  std::vector<std::string> words;
  for (const auto& stream : offer.streams) words.push_back(words_of(stream));
  if (asks && words.size() > 1) {
    const std::string picked = ask_which(std::cin, std::cout, "Which stream?", words);
    return offer
        .streams[static_cast<std::size_t>(std::ranges::find(words, picked) - words.begin())];
  }
  const std::string* wanted = find(values, "station.mount.profile");
  for (const auto& stream : offer.streams) {
    if (wanted != nullptr ? toml_text(stream.profile.token) == *wanted : stream.ptz.has_value())
      return stream;
  }
  if (wanted != nullptr) throw std::runtime_error("the ONVIF camera has no profile " + *wanted);
  return offer.streams.front();
}

// A value of the mount or, if it has none, of the camera.
std::string stated(const Values& values, const std::string& key) {
  for (const char* device : {"station.mount.", "station.camera."}) {
    if (const std::string* value = find(values, device + key)) return text_in(*value).value_or("");
  }
  return {};
}

struct Learnt {
  onvif::Offer offer;
  std::string user, password_file;
};

Learnt learn_as_stated(const std::string& url, const Host& host, const Values& values) {
  const std::string user = stated(values, "user"), file = stated(values, "password_file");
  const std::string password = device::read_password(file.empty() ? "" : host.path(file));
  return {learn_onvif(url, {user, password}, stated(values, "pinned_key")), user, file};
}

// Asks until the camera takes what is typed. Cameras lock an account after a few tries, so a person
// makes each of them.
Learnt learn_with_a_person(const std::string& url, const Host& host, const Answers& answers) {
  for (;;) {
    std::printf("The login goes to %s\n", plain_text(url).c_str());
    const onvif::Credentials login = ask_login();
    try {
      Learnt learnt{learn_onvif(url, login, stated(answers.values, "pinned_key")), login.user, ""};
      if (login.user.empty()) return learnt;
      learnt.password_file = keep_password(host, answers.station, login.password);
      std::printf("%s: written\n", host.path(learnt.password_file).c_str());
      return learnt;
    } catch (const onvif::LoginRefused& refused) {
      std::printf("  %s\n", refused.what());
    }
  }
}

void take_onvif(const std::string& url, const Host& host, Answers& answers, bool asks) {
  Values& values = answers.values;
  const Learnt learnt = asks && stated(values, "user").empty()
                            ? learn_with_a_person(url, host, answers)
                            : learn_as_stated(url, host, values);
  const auto& stream = one_stream(learnt.offer, values, asks);
  add_onvif(values, url, stream, {learnt.user, learnt.password_file});
  std::printf("camera: %s at %s, stream %s\n", learnt.offer.device.c_str(), url.c_str(),
              words_of(stream).c_str());
}

// The answers want an ONVIF camera: the stated one, or the one that is found.
void take_wanted_onvif(const Host& host, Answers& answers, bool asks) {
  if (const std::string* url = find(answers.values, "station.mount.url"))
    return take_onvif(text_in(*url).value_or(""), host, answers, asks);
  const auto found = find_onvif();
  std::vector<std::string> words;
  for (const auto& camera : found) words.push_back(words_of(camera));
  const std::string picked = one_of(words, "ONVIF camera", "station.mount.url", asks);
  const auto at = std::ranges::find(words, picked);
  take_onvif(at == words.end() ? picked : found[at - words.begin()].url, host, answers, asks);
}

// GigE Vision cameras and, where a person chooses, those of ONVIF.
void find_camera(const Host& host, Answers& answers, bool asks) {
  std::vector<std::string> cameras;
  for (const auto& camera : doctor::cameras_that_answer()) cameras.push_back(camera.id);
  const std::size_t own = cameras.size();
  std::vector<onvif::FoundCamera> found;
  if (asks) found = find_onvif();
  for (const auto& camera : found) cameras.push_back(words_of(camera));
  const std::string key =
      asks ? "station.camera.device, or the address of an ONVIF camera's device service"
           : "station.camera.device, or kind = \"rtsp\" for one by ONVIF";
  const std::string camera = one_of(cameras, "camera", key, asks);
  const auto at = static_cast<std::size_t>(std::ranges::find(cameras, camera) - cameras.begin());
  if (at >= own && at < cameras.size()) return take_onvif(found[at - own].url, host, answers, asks);
  if (camera.starts_with("http")) return take_onvif(camera, host, answers, asks);
  add(answers.values, "station.camera.device", camera);
  std::printf("camera: %s\n", camera.c_str());
}

// A device, or the name of a kind that has none.
void take_mount(const std::string& said, Answers& answers) {
  const bool is_kind = std::ranges::any_of(station::mount_kinds(),
                                           [&](const auto& row) { return said == row.name; });
  add(answers.values, is_kind ? "station.mount.kind" : "station.mount.device", said);
}

}  // namespace

void choose_devices(const Host& host, Answers& answers, bool asks) {
  if (wants_onvif(answers.values)) take_wanted_onvif(host, answers, asks);
  if (!has_camera(answers.values)) find_camera(host, answers, asks);
  std::vector<std::string> lines = answers.serial.empty() ? serial_lines() : answers.serial;
  if (!has_mount(answers.values)) {
    std::vector<std::string> units;
    for (const auto& unit : find_ptus(lines)) {
      units.push_back(unit.device);
      std::printf("PTU: %s on %s at %d baud\n", unit.version.c_str(), unit.device.c_str(),
                  unit.baud);
    }
    take_mount(one_of(units, "PTU", "station.mount.device, or \"fixed\"", asks), answers);
  }
  std::erase_if(lines, [&](const std::string& line) {
    return mount_device(answers.values) == toml_text(line);
  });
  if (!answers.gnss.empty()) return;
  const auto receivers = find_receivers(lines);
  if (receivers.empty()) return;
  answers.gnss = one_of(receivers, "GNSS receiver", "gnss", asks);
  std::printf("GNSS receiver: %s\n", answers.gnss.c_str());
}

}  // namespace ols::setup
