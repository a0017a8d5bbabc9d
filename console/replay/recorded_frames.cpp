#include "console/replay/recorded_frames.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "base/files/small_file.h"
#include "base/text/plain_text.h"

namespace ols::console {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostProblems = 20;
constexpr const char* kTable = "frames.csv";

struct Row {
  std::int64_t utime_us = 0;
  std::string file;
};

// "utime_us,number,file,..."; nothing if it is not that, or names a file elsewhere.
std::optional<Row> row_of(const std::string& line) {
  Row row;
  const char* const end = line.data() + line.size();
  const auto [after, error] = std::from_chars(line.data(), end, row.utime_us);
  const auto second = line.find(',');
  const auto third = second == std::string::npos ? second : line.find(',', second + 1);
  if (error != std::errc() || *after != ',' || row.utime_us <= 0 || third == std::string::npos) {
    return std::nullopt;
  }
  row.file = line.substr(third + 1, line.find(',', third + 1) - third - 1);
  if (!row.file.ends_with(".png") || row.file.find('/') != std::string::npos) return std::nullopt;
  return row;
}

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = at; i < at + 4; ++i)
    value = value << 8U | static_cast<unsigned char>(bytes[i]);
  return value;
}

}  // namespace

std::optional<std::pair<int, int>> png_size(const std::string& png) {
  constexpr std::uint32_t kMostPixels = 100'000;
  if (png.size() < 24 || !png.starts_with("\x89PNG\r\n\x1a\n")) return std::nullopt;
  const std::uint32_t width = big_endian(png, 16), height = big_endian(png, 20);
  if (width == 0 || height == 0 || width > kMostPixels || height > kMostPixels) return std::nullopt;
  return std::pair{static_cast<int>(width), static_cast<int>(height)};
}

void RecordedFrames::problem(const std::string& text) {
  if (problems_.size() < kMostProblems) problems_.push_back(plain_text(text));
}

void RecordedFrames::add_event(const std::string& station, const std::string& path,
                               const std::string& name) {
  std::ifstream table(path + "/" + kTable);
  std::string line;
  if (!std::getline(table, line) || !line.starts_with("utime_us,number,file")) {
    return problem(path + "/" + kTable + ": is no table of frames");
  }
  auto& files = stations_[station].files;
  std::int64_t first_us = 0, last_us = 0;
  std::size_t frames = 0;
  for (int number = 2; std::getline(table, line) && frames_ < kMostFrames; ++number) {
    const auto row = row_of(line);
    if (!row) {
      problem(path + "/" + kTable + ":" + std::to_string(number) + ": is no row of a frame");
      continue;
    }
    files[row->utime_us] = path + "/" + row->file;
    first_us = first_us == 0 ? row->utime_us : std::min(first_us, row->utime_us);
    last_us = std::max(last_us, row->utime_us);
    ++frames_;
    ++frames;
  }
  if (frames == 0) return problem(path + ": has no frame");
  events_.push_back({{"station", station},
                     {"name", plain_text(name)},
                     {"first_us", first_us},
                     {"last_us", last_us},
                     {"frames", frames}});
}

void RecordedFrames::add(const std::string& station, const std::string& folder) {
  std::error_code error;
  fs::directory_iterator entries(folder, error);
  if (error) throw std::invalid_argument(folder + ": " + error.message());
  std::vector<std::string> names;
  for (const auto& entry : entries) {
    if (fs::exists(entry.path() / kTable, error)) names.push_back(entry.path().filename().string());
  }
  if (names.empty()) throw std::invalid_argument(folder + ": has no recorded event");
  std::ranges::sort(names);
  for (const std::string& name : names) add_event(station, folder + "/" + name, name);
}

std::optional<Picture> RecordedFrames::newest(const std::string& station, std::int64_t utime_us) {
  const auto found = stations_.find(station);
  if (found == stations_.end()) return std::nullopt;
  Frames& frames = found->second;
  const auto after = frames.files.upper_bound(utime_us);
  if (after == frames.files.begin()) return std::nullopt;
  const auto& [at_us, file] = *std::prev(after);
  if (utime_us - at_us > kOld_us || at_us == frames.given_us) return std::nullopt;
  frames.given_us = at_us;
  try {
    std::string png = read_small_file(file, kMostFrameBytes);
    const auto size = png_size(png);
    if (!size) throw std::invalid_argument(file + ": is no PNG");
    return Picture{station,
                   {{"station", station},
                    {"utime_us", at_us},
                    {"full_px", {size->first, size->second}},
                    {"box_px", nullptr},
                    {"recorded", true}},
                   std::move(png),
                   true};
  } catch (const std::exception& error) {
    problem(error.what());
    return std::nullopt;
  }
}

std::vector<std::string> RecordedFrames::stations() const {
  std::vector<std::string> names;
  for (const auto& [station, frames] : stations_) names.push_back(station);
  return names;
}

}  // namespace ols::console
