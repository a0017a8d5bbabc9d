#include "tools/calibrate/calibration_store.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "base/files/append_line.h"

namespace ols::calibration {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRunning = ".running";
constexpr const char* kInterrupted = ".interrupted";
constexpr const char* kCurrent = "current";
constexpr const char* kInstrument = "instrument";

[[noreturn]] void fail(const fs::path& path) {
  throw std::system_error(errno, std::generic_category(), path.string());
}

void sync(const fs::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) fail(path);
  const bool synced = ::fsync(file) == 0;
  ::close(file);
  if (!synced) fail(path);
}

// Syncs everything in the folder: otherwise a name may stand for an empty file after a loss of
// power.
void sync_tree(const fs::path& folder) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_directory() || entry.is_regular_file()) sync(entry.path());
  }
  sync(folder);
}

std::string stamp(std::int64_t utime_us) {
  const std::time_t seconds = utime_us / 1'000'000;
  std::tm utc{};
  ::gmtime_r(&seconds, &utc);
  char text[40];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H-%M-%SZ", &utc);
  return text;
}

// A name that is not taken: the one given, or with a number.
fs::path free_name(const fs::path& wanted, const std::string& ending) {
  fs::path name = wanted.string() + ending;
  for (int n = 2; fs::exists(fs::symlink_status(name)); ++n) {
    name = wanted.string() + "-" + std::to_string(n) + ending;
  }
  return name;
}

}  // namespace

CalibrationStore::CalibrationStore(fs::path folder) : folder_(std::move(folder)) {
  fs::create_directories(folder_);
}

CalibrationStore::~CalibrationStore() {
  if (lock_ >= 0) ::close(lock_);
}

std::vector<fs::path> CalibrationStore::lock() {
  const fs::path path = folder_ / "lock";
  lock_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (lock_ < 0) fail(path);
  if (::flock(lock_, LOCK_EX | LOCK_NB) != 0) {
    throw std::runtime_error(folder_.string() + ": another procedure is at work here");
  }
  std::vector<fs::path> dead;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    if (entry.is_directory() && entry.path().extension() == kRunning) dead.push_back(entry.path());
  }
  std::ranges::sort(dead);
  for (fs::path& one : dead) one = interrupt(one);
  complete();
  return dead;
}

// Completes what a loss of power cut short: the history's last line says what a person decided.
void CalibrationStore::complete() const {
  const auto lines = history();
  if (lines.empty()) return;
  const HistoryLine& last = lines.back();
  if (!has(last.id)) return;  // somebody has removed it since
  const bool brings_setup = last.event == "accepted" || last.event == "reverted";
  const auto now = current();
  if (brings_setup && (now == last.id || now.value_or("") == last.previous)) switch_to(last.id);
  if (last.event == "instrument") link(kInstrument, last.id);
}

void CalibrationStore::switch_to(const std::string& id) const {
  if (current() != id) link(kCurrent, id);
  std::error_code none;
  fs::remove(folder_ / kInstrument, none);  // its own is the newest now
  sync(folder_);
}

fs::path CalibrationStore::begin(const std::string& procedure, std::int64_t utime_us) {
  const fs::path path = free_name(folder_ / (stamp(utime_us) + "-" + procedure), kRunning);
  fs::create_directory(path);
  sync(folder_);
  return path;
}

fs::path CalibrationStore::interrupt(const fs::path& running) {
  fs::path stem = running;
  const fs::path to = free_name(stem.replace_extension(""), kInterrupted);
  fs::rename(running, to);
  sync(folder_);
  return to;
}

std::vector<fs::path> CalibrationStore::interrupted() const {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    if (entry.is_directory() && entry.path().extension() == kInterrupted) {
      found.push_back(entry.path());
    }
  }
  std::ranges::sort(found);  // their names begin with the time
  return found;
}

fs::path CalibrationStore::resume(const fs::path& interrupted) {
  fs::path stem = interrupted;
  const fs::path to = free_name(stem.replace_extension(""), kRunning);
  fs::rename(interrupted, to);
  sync(folder_);
  return to;
}

fs::path CalibrationStore::keep(const fs::path& running, const std::string& id) {
  const fs::path to = folder_ / id;
  if (fs::exists(to)) throw std::runtime_error(to.string() + ": exists already");
  sync_tree(running);
  fs::rename(running, to);
  sync(folder_);
  return to;
}

std::optional<std::string> CalibrationStore::current() const {
  std::error_code none;
  const fs::path to = fs::read_symlink(folder_ / kCurrent, none);
  if (none || to.empty()) return std::nullopt;
  return to.filename().string();
}

bool CalibrationStore::has(const std::string& id) const {
  const bool is_name = !id.empty() && id.find('/') == std::string::npos && id != "." && id != "..";
  return is_name && fs::is_regular_file(folder_ / id / "instrument.toml");
}

void CalibrationStore::use(const std::string& id, HistoryLine line) {
  if (!has(id)) throw std::runtime_error(folder_.string() + ": has no calibration '" + id + "'");
  if (!fs::exists(folder_ / id / "setup.toml")) {
    throw std::runtime_error(folder_.string() + ": '" + id + "' is an instrument without a setup");
  }
  line.id = id;
  line.previous = current().value_or("");
  note(line);
  switch_to(id);
}

void CalibrationStore::use_instrument(const std::string& id, HistoryLine line) {
  if (!has(id)) throw std::runtime_error(folder_.string() + ": has no instrument '" + id + "'");
  line.id = id;
  line.previous = current().value_or("");
  note(line);
  link(kInstrument, id);
}

void CalibrationStore::link(const char* name, const std::string& id) const {
  const fs::path next = folder_ / (std::string(name) + ".next");
  std::error_code none;
  fs::remove(next, none);
  fs::create_directory_symlink(id, next);
  fs::rename(next, folder_ / name);
  sync(folder_);
}

std::optional<fs::path> CalibrationStore::instrument_file() const {
  for (const char* name : {kInstrument, kCurrent}) {
    const fs::path path = folder_ / name / "instrument.toml";
    if (fs::exists(path)) return path;
  }
  return std::nullopt;
}

void CalibrationStore::note(const HistoryLine& line) {
  nlohmann::ordered_json object{{"utime_us", line.utime_us},
                                {"event", line.event},
                                {"id", line.id},
                                {"procedure", line.procedure},
                                {"previous", line.previous}};
  append_line(folder_ / "history.jsonl", object.dump());
}

std::vector<HistoryLine> CalibrationStore::history() const {
  std::vector<HistoryLine> lines;
  std::ifstream file(folder_ / "history.jsonl");
  for (std::string text; std::getline(file, text);) {
    const auto object = nlohmann::json::parse(text, nullptr, false);
    if (!object.is_object()) continue;
    try {
      lines.push_back({object.at("utime_us"), object.at("event"), object.at("id"),
                       object.at("procedure"), object.at("previous")});
    } catch (const nlohmann::json::exception&) {
      continue;
    }
  }
  return lines;
}

std::optional<std::string> CalibrationStore::previous() const {
  const auto now = current();
  const auto lines = history();
  // The procedure that brought the current calibration says which was before it. Reverts do not
  // count, because two of them would lead to and fro.
  for (auto line = lines.rbegin(); line != lines.rend(); ++line) {
    if (line->event != "accepted" || line->id != now) continue;
    if (line->previous.empty() || line->previous == now || !has(line->previous))
      return std::nullopt;
    return line->previous;
  }
  return std::nullopt;
}

}  // namespace ols::calibration
