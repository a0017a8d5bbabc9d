// The main program of a fuzzer that is not built with libFuzzer: takes each file of the folders
// named, once. A folder that is missing has no seeds. Ends with 2 if there was no file at all.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

std::string content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

int take_each(const std::filesystem::path& folder) {
  int taken = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    // Named before it is taken: the program may end there.
    std::printf("%s\n", entry.path().c_str());
    std::fflush(stdout);
    const std::string bytes = content(entry.path());
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    ++taken;
  }
  return taken;
}

}  // namespace

int main(int argc, char** argv) {
  int taken = 0;
  for (int i = 1; i < argc; ++i) {
    if (std::filesystem::is_directory(argv[i])) taken += take_each(argv[i]);
  }
  if (taken == 0) std::fprintf(stderr, "no seed in the folders named\n");
  return taken == 0 ? 2 : 0;
}
