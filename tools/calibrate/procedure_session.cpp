#include "tools/calibrate/procedure_session.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <stdexcept>

#include "base/files/append_line.h"
#include "base/files/atomic_file.h"
#include "conditions/printed.h"
#include "tools/calibrate/observation_writer.h"

namespace ols::calibration {
namespace fs = std::filesystem;
namespace {

constexpr const char* kJournal = "journal.jsonl";

// The lines of a file. A line that a loss of power has cut is removed, or the next one would be
// joined to it.
std::string whole_lines(const fs::path& path) {
  if (!fs::exists(path)) return {};
  std::ifstream file(path);
  std::string text(std::istreambuf_iterator<char>(file), {});
  const std::size_t whole = text.rfind('\n') + 1;
  if (whole == text.size()) return text;
  text.resize(whole);
  fs::resize_file(path, whole);
  return text;
}

}  // namespace

Taken ProcedureSession::add(FrameFile frame, bool is_view) {
  frame.taken.pose = ++poses_;
  const fs::path frames = folder_ / "frames";
  fs::create_directories(frames);
  const std::string name =
      printed("%06lld.%s", static_cast<long long>(poses_), frame.lossless ? "png" : "jpg");
  AtomicFile picture((frames / name).string());
  picture.stream().write(reinterpret_cast<const char*>(frame.file.data()),
                         static_cast<std::streamsize>(frame.file.size()));
  picture.commit();
  const StoredPicture stored{
      poses_, frames / name, frame.taken.utime_us, frame.taken.reading, frame.taken.angles,
      is_view};
  append_line(folder_ / kFramesFile, line_of(stored, folder_));
  return std::move(frame.taken);
}

void ProcedureSession::write(const std::string& name, const std::string& text) const {
  AtomicFile file((folder_ / name).string());
  file.stream() << text;
  file.commit();
}

void ProcedureSession::write_observations(const std::vector<Observation>& observations) const {
  write(observations_path().filename().string(), observation_lines(observations, station_));
}

void ProcedureSession::note(const JournalEntry& entry) const {
  append_line(folder_ / kJournal, journal_line(entry));
}

void ProcedureSession::read_frames() {
  const std::string lines = whole_lines(folder_ / kFramesFile);
  for (StoredPicture& picture : stored_pictures(folder_, lines)) {
    poses_ = std::max(poses_, picture.pose);
    frames_[picture.pose] = std::move(picture);
  }
}

void ProcedureSession::resume() {
  read_frames();
  const fs::path journal = folder_ / kJournal;
  for (JournalEntry& one : journal_entries(whole_lines(journal), journal.string())) {
    replay_.push_back(std::move(one));
  }
  while (fs::exists(folder_ / ("result-" + std::to_string(results_ + 1)))) ++results_;
}

bool ProcedureSession::take_resumed() {
  if (replay_.empty() || replay_.front().kind != JournalEntry::Kind::kResumed) return false;
  replay_.pop_front();
  return true;
}

std::optional<std::int64_t> ProcedureSession::replayed_utime_us() const {
  if (replay_.empty() || replay_.front().ordered_utime_us == 0) return std::nullopt;
  return replay_.front().ordered_utime_us;
}

JournalEntry ProcedureSession::replayed(const Order& order) {
  const JournalEntry entry = replay_.front();
  if (!answers(entry, order)) {
    throw std::runtime_error("the next step of the interrupted procedure was '" + entry.step +
                             "', that of this one is '" + order.step +
                             "': the station or its references have changed; begin anew");
  }
  replay_.pop_front();
  return entry;
}

Taken ProcedureSession::stored(std::int64_t pose) const {
  const auto frame = frames_.find(pose);
  if (frame == frames_.end()) {
    throw std::runtime_error((folder_ / kFramesFile).string() + ": has no picture " +
                             std::to_string(pose));
  }
  const StoredPicture& picture = frame->second;
  return {gray_of(picture), picture.reading, picture.angles, picture.utime_us, pose};
}

fs::path ProcedureSession::next_result() {
  return folder_ / ("result-" + std::to_string(++results_));
}

void ProcedureSession::take_result() const {
  const fs::path result = folder_ / ("result-" + std::to_string(results_));
  // Replaces an earlier result, if the procedure was interrupted between its end and its storing.
  constexpr auto kHow = fs::copy_options::recursive | fs::copy_options::overwrite_existing;
  for (const auto& entry : fs::directory_iterator(result)) {
    fs::copy(entry.path(), folder_ / entry.path().filename(), kHow);
  }
}

}  // namespace ols::calibration
