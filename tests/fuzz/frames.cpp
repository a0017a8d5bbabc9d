// Where ols-track takes its pictures from: folders with any names, patterns, pictures with any
// content. What cannot be read is refused by name; what is read is a grey picture.
#include <filesystem>
#include <fstream>
#include <opencv2/core/utils/logger.hpp>

#include "tests/fuzz/fuzz_input.h"
#include "tools/offline/frame_source.h"

namespace {

namespace fs = std::filesystem;
using ols::fuzz::Input;
using ols::fuzz::require;

// In memory, with nothing in it.
fs::path empty_folder() {
  static const fs::path folder = [] {
    std::string name = (fs::temp_directory_path() / "ols-fuzz-XXXXXX").string();
    require(mkdtemp(name.data()) != nullptr, "mkdtemp");
    return fs::path(name);
  }();
  for (const auto& entry : fs::directory_iterator(folder)) fs::remove_all(entry);
  return folder;
}

// A file's name: no way out of the folder.
std::string name(Input& input) {
  std::string text;
  for (const char c : input.take(input.byte() % 16)) {
    text += c == '/' || c == '\0' ? '_' : c;
  }
  static constexpr const char* kKinds[] = {".png", ".pgm", ".JPG", ".bmp", "", ".txt"};
  return "f" + text + kKinds[input.byte() % std::size(kKinds)];
}

std::string content(Input& input) {
  const std::uint8_t kind = input.byte();
  const std::string bytes(input.take(input.byte()));
  if (kind % 3 == 0) return bytes;
  const int width = 1 + kind % 20, height = 1 + kind / 16;
  std::string pgm =
      "P5\n" + std::to_string(width) + " " + std::to_string(height) + "\n255\n" + bytes;
  if (kind % 3 == 1) pgm.resize(pgm.size() + static_cast<std::size_t>(width * height), '\x7f');
  return pgm;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  Input input(data, size);
  const fs::path folder = empty_folder();
  const std::uint8_t kind = input.byte();
  const std::string pattern = name(input);
  long files = 0;
  for (; files < 8 && !input.empty(); ++files) {
    std::string file = name(input);
    // Now and then a number, as in numbered pictures.
    if (kind % 2 == 0) file = "f" + std::to_string(input.byte() % 16) + ".pgm";
    std::ofstream(folder / file, std::ios::binary) << content(input);
  }
  const std::string given = kind % 4 < 2 ? folder.string() : (folder / pattern).string();
  try {
    ols::offline::FrameSource source(kind % 4 == 2 ? (folder / "f%d.pgm").string() : given);
    long frames = 0;
    for (auto picture = source.next(); picture; picture = source.next(), ++frames) {
      require(!picture->empty() && picture->type() == CV_8UC1, "a grey picture of 8 bits");
      require(frames < 10000, "pictures come to an end");
    }
  } catch (const ols::offline::FrameSourceError& error) {
    require(std::string_view(error.what()).size() > 1, "a reason is named");
  }
  return 0;
}
