#include "tools/setup/chosen_devices.h"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <vector>

#include "base/config/toml_text.h"
#include "base/text/plain_text.h"
#include "edge/config/device_kinds.h"
#include "edge/device/password_file.h"
#include "tools/setup/camera_picture.h"
#include "tools/setup/dialogue.h"
#include "tools/setup/find_devices.h"
#include "tools/setup/find_onvif.h"
#include "tools/setup/find_v4l2.h"
#include "tools/setup/finders.h"
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
  std::string user, password_file, pinned_key;
};

Learnt learn_as_stated(const std::string& url, const Host& host, const Values& values) {
  const std::string user = stated(values, "user"), file = stated(values, "password_file");
  const std::string password = device::read_password(file.empty() ? "" : host.path(file));
  const std::string pin = stated(values, "pinned_key");
  return {learn_onvif(url, {user, password}, pin), user, file, pin};
}

// Asks until the camera takes what is typed. Cameras lock an account after a few tries, so a person
// makes each of them.
Learnt learn_with_a_person(const std::string& url, const Host& host, const Answers& answers) {
  std::string pin = stated(answers.values, "pinned_key");
  for (;;) {
    std::printf("The login goes to %s\n", plain_text(url).c_str());
    const onvif::Credentials login = ask_login();
    try {
      Learnt learnt{learn_onvif(url, login, pin), login.user, "", pin};
      if (login.user.empty()) return learnt;
      learnt.password_file = keep_password(host, answers.station, login.password);
      std::printf("%s: written\n", host.path(learnt.password_file).c_str());
      return learnt;
    } catch (const onvif::LoginRefused& refused) {
      std::printf("  %s\n", refused.what());
    } catch (const onvif::CertificateRefused& refused) {
      if (refused.key.empty() || !pin.empty()) throw;
      std::printf("  %s\n", refused.what());
      const std::vector<std::string> replies{"no, stop", "yes, pin it"};
      const std::string words = "Does the camera's own page show this key?";
      if (ask_which(std::cin, std::cout, words, replies) == replies.front()) throw;
      pin = refused.key;
    }
  }
}

void take_onvif(const std::string& url, const Host& host, Answers& answers, bool asks) {
  Values& values = answers.values;
  const Learnt learnt = asks && stated(values, "user").empty()
                            ? learn_with_a_person(url, host, answers)
                            : learn_as_stated(url, host, values);
  const auto& stream = one_stream(learnt.offer, values, asks);
  add_onvif(values, url, stream, {learnt.user, learnt.password_file, learnt.pinned_key});
  std::printf("camera: %s at %s, stream %s\n", learnt.offer.device.c_str(), url.c_str(),
              words_of(stream).c_str());
}

constexpr const char* kOther = "another one, or none of these";

// What a person or the answers name in the place of a device that was found.
Found named_camera(const std::string& said) {
  if (said.starts_with("http")) return {said, {}, said};
  if (said.starts_with("/dev/")) {
    const auto found = find_v4l2({said});
    if (found.empty()) throw std::runtime_error(said + " is no camera that a station can use");
    return found.front();
  }
  return {said, {{"station.camera.device", toml_text(said)}}};
}

// A device, or the name of a kind.
Found named_mount(const std::string& said) {
  if (said.starts_with("http")) return {said, {}, said};
  const bool is_kind = std::ranges::any_of(station::mount_kinds(),
                                           [&](const auto& row) { return said == row.name; });
  return {said, {{is_kind ? "station.mount.kind" : "station.mount.device", toml_text(said)}}};
}

struct Wanted {
  std::string what, key;  // in messages
  Found (*named)(const std::string& said);
};

// A person chooses among what was found, or names something else.
Found ask_for(const std::vector<Found>& found, const Wanted& wanted) {
  if (found.empty()) return wanted.named(one_of({}, wanted.what, wanted.key, true));
  std::vector<std::string> words;
  for (const Found& one : found) words.push_back(one.words);
  words.emplace_back(kOther);
  const std::string picked = ask_which(std::cin, std::cout, "Which " + wanted.what + "?", words);
  const auto at = static_cast<std::size_t>(std::ranges::find(words, picked) - words.begin());
  if (at < found.size()) return found[at];
  return wanted.named(ask_text(std::cin, std::cout, "What is to be " + wanted.key + "?"));
}

// Without a person, the only one of the kind.
Found only_one(const std::vector<Found>& found, const Wanted& wanted) {
  std::vector<std::string> words;
  for (const Found& one : found) words.push_back(one.words);
  const std::string picked = one_of(words, wanted.what, wanted.key, false);
  return found[static_cast<std::size_t>(std::ranges::find(words, picked) - words.begin())];
}

// All finders for a person who has not stated a kind; otherwise that of the kind.
std::vector<Finder> finders_of(const std::vector<Finder>& all, const std::string& device,
                               const Values& values, bool asks) {
  const std::string* kind = find(values, device + ".kind");
  if (kind == nullptr && asks) return all;
  std::vector<Finder> chosen;
  std::ranges::copy_if(all, std::back_inserter(chosen), [&](const Finder& finder) {
    return kind == nullptr ? finder.kind == all.front().kind : toml_text(finder.kind) == *kind;
  });
  return chosen;
}

Search search_of(const Answers& answers) {
  Search search;
  search.lines = answers.serial.empty() ? serial_lines() : answers.serial;
  const auto number = [&](const char* key, int& value) {
    if (const std::string* stated = find(answers.values, key)) value = std::stoi(*stated);
  };
  number("station.mount.port", search.indi_port);
  number("station.mount.address", search.pelco_address);
  if (const std::string* host = find(answers.values, "station.mount.host"))
    search.indi_host = text_in(*host).value_or("");
  return search;
}

void take(const Found& found, const Host& host, Answers& answers, bool asks) {
  if (!found.onvif.empty()) return take_onvif(found.onvif, host, answers, asks);
  for (const auto& [key, value] : found.values) {
    if (find(answers.values, key) == nullptr) answers.values.emplace_back(key, value);
  }
}

// The answers want an ONVIF camera: the stated one, or the one that is found.
void take_wanted_onvif(const Host& host, Answers& answers, bool asks) {
  if (const std::string* url = find(answers.values, "station.mount.url"))
    return take_onvif(text_in(*url).value_or(""), host, answers, asks);
  const Wanted wanted{"ONVIF camera", "station.mount.url", [](const std::string& said) {
                        return Found{said, {}, said};
                      }};
  std::vector<Found> found;
  for (const auto& camera : find_onvif()) found.push_back({words_of(camera), {}, camera.url});
  take(asks ? ask_for(found, wanted) : only_one(found, wanted), host, answers, asks);
}

void find_camera(const Host& host, Answers& answers, bool asks) {
  const auto finders = finders_of(camera_finders(), "station.camera", answers.values, asks);
  const bool all = finders.size() > 1;
  const Wanted wanted{
      all ? "camera" : finders.front().called,
      asks ? "station.camera.device, or the address of an ONVIF camera's device service"
           : "station.camera.device, or kind = \"rtsp\" for one by ONVIF, or \"v4l2\"",
      named_camera};
  const auto found = find_all(finders, search_of(answers));
  const Found one = asks ? ask_for(found, wanted) : only_one(found, wanted);
  take(one, host, answers, asks);
  if (one.onvif.empty()) std::printf("camera: %s\n", one.words.c_str());
}

// Shows the picture of a camera that was found in this run, and lets a person choose again.
void choose_camera(const Host& host, Answers& answers, bool asks) {
  const bool wants = wants_onvif(answers.values);
  if (!wants && has_camera(answers.values)) return;
  const Values before = answers.values;
  for (;;) {
    if (wants) take_wanted_onvif(host, answers, asks);
    if (has_camera(before)) return;
    if (!has_camera(answers.values)) find_camera(host, answers, asks);
    show_picture(host, answers.station, answers.values);
    if (!asks) return;
    const std::vector<std::string> replies{"yes", "no, choose again"};
    if (ask_which(std::cin, std::cout, "Is this the camera?", replies) == replies.front()) return;
    answers.values = before;
  }
}

void choose_mount(const Host& host, Answers& answers, bool asks) {
  while (!has_mount(answers.values)) {
    const auto finders = finders_of(mount_finders(), "station.mount", answers.values, asks);
    const bool all = finders.size() > 1;
    const Wanted wanted{all ? "mount" : finders.front().called,
                        "station.mount.device, or \"fixed\"", named_mount};
    const auto found = find_all(finders, search_of(answers));
    const Found one = asks ? ask_for(found, wanted) : only_one(found, wanted);
    take(one, host, answers, asks);
    std::printf("mount: %s\n", one.words.c_str());
    const std::string* kind = value_of(one, "station.mount.kind");
    if (asks && kind != nullptr && *kind == toml_text("indi")) {
      add(answers.values, "station.mount.axes",
          ask_which(std::cin, std::cout, "How do its axes stand?", {"equatorial", "altazimuth"}));
    }
  }
}

}  // namespace

void choose_devices(const Host& host, Answers& answers, bool asks) {
  choose_camera(host, answers, asks);
  choose_mount(host, answers, asks);
  if (!answers.gnss.empty()) return;
  std::vector<std::string> lines = search_of(answers).lines;
  std::erase_if(lines, [&](const std::string& line) {
    return mount_device(answers.values) == toml_text(line);
  });
  const auto receivers = find_receivers(lines);
  if (receivers.empty()) return;
  answers.gnss = one_of(receivers, "GNSS receiver", "gnss", asks);
  std::printf("GNSS receiver: %s\n", answers.gnss.c_str());
}

}  // namespace ols::setup
