#include "edge/recorder/event_folder.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cinttypes>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string_view>
#include <system_error>

#include "conditions/printed.h"

namespace ols::recorder {
namespace {

constexpr const char* kTable = "frames.csv";

[[noreturn]] void fail(int error, const std::string& path) {
  throw std::system_error(error, std::generic_category(), path);
}

class File {
 public:
  File(const std::string& path, int flags) : path_(path) {
    fd_ = ::open(path.c_str(), flags | O_CLOEXEC, 0644);
    if (fd_ < 0) fail(errno, path);
  }
  ~File() {
    if (fd_ >= 0) ::close(fd_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  void write(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t n = ::write(fd_, bytes.data(), bytes.size());
      if (n > 0) bytes.remove_prefix(static_cast<std::size_t>(n));
      if (n == 0) fail(EIO, path_);
      if (n < 0 && errno != EINTR) fail(errno, path_);
    }
  }
  off_t size() const { return ::lseek(fd_, 0, SEEK_END); }
  void truncate(off_t size) { [[maybe_unused]] const int ignored = ::ftruncate(fd_, size); }
  void close() {
    const int closed = ::close(fd_);
    fd_ = -1;
    if (closed != 0) fail(errno, path_);
  }
  int fd() const { return fd_; }

 private:
  std::string path_;
  int fd_ = -1;
};

// Writes all of the text or nothing.
void append(const std::string& path, std::string_view text) {
  File table(path, O_WRONLY | O_CREAT | O_APPEND);
  const off_t before = table.size();
  try {
    table.write(text);
  } catch (...) {
    table.truncate(before);
    throw;
  }
  table.close();
}

}  // namespace

std::vector<unsigned char> encode_png(const RecordedFrame& frame) {
  std::vector<unsigned char> png;
  // OpenCV stores three channels as blue, green, red; the file must have true colours. Into
  // separate memory, because the frame shares its pixels.
  cv::Mat swapped;
  if (frame.pixel_format == "RGB8") cv::cvtColor(frame.picture, swapped, cv::COLOR_RGB2BGR);
  const cv::Mat& picture = swapped.empty() ? frame.picture : swapped;
  // On camera noise Huffman coding alone is both the fastest and the smallest.
  cv::imencode(".png", picture, png,
               {cv::IMWRITE_PNG_COMPRESSION, 1, cv::IMWRITE_PNG_STRATEGY,
                cv::IMWRITE_PNG_STRATEGY_HUFFMAN_ONLY});
  return png;
}

EventFolder::EventFolder(const std::string& store, const std::string& name)
    : path_(store + "/" + name) {
  const std::string partial = path_ + kPartial;
  if (::mkdir(partial.c_str(), 0755) != 0) fail(errno, partial);
  try {
    append(partial + "/" + kTable,
           "utime_us,number,file,mid_exposure_sd_s,pixel_format,stamp_source\n");
  } catch (...) {
    ::unlink((partial + "/" + kTable).c_str());
    ::rmdir(partial.c_str());
    throw;
  }
}

std::size_t EventFolder::write(const RecordedFrame& frame, const std::vector<unsigned char>& png) {
  const std::string folder = path_ + kPartial + "/";
  std::string name = std::to_string(frame.utime_us) + ".png";
  // After a step of the clock two frames may have the same time.
  if (::access((folder + name).c_str(), F_OK) == 0) {
    name = std::to_string(frame.utime_us) + "_" + std::to_string(frame.number) + ".png";
  }
  const std::string path = folder + name;
  const std::string row =
      printed("%" PRId64 ",%" PRIu64 ",%s,%.9f,%s,%s\n", frame.utime_us, frame.number, name.c_str(),
              frame.sd_s, frame.pixel_format.c_str(),
              frame.stamp_source == camera::StampSource::kArrival ? "arrival" : "camera");
  File file(path, O_WRONLY | O_CREAT | O_EXCL);
  try {
    file.write({reinterpret_cast<const char*>(png.data()), png.size()});
    file.close();
    append(folder + kTable, row);
  } catch (...) {
    ::unlink(path.c_str());
    throw;
  }
  return png.size() + std::string_view(row).size();
}

bool EventFolder::exists() const {
  // If the disk does not answer, the folder counts as present.
  return ::access((path_ + kPartial).c_str(), F_OK) == 0 || (errno != ENOENT && errno != ENOTDIR);
}

void EventFolder::finish() {
  const std::string partial = path_ + kPartial;
  {
    // After a power failure, a name without its content would be worse than no event.
    const File folder(partial, O_RDONLY | O_DIRECTORY);
    if (::syncfs(folder.fd()) != 0) fail(errno, partial);
  }
  if (::rename(partial.c_str(), path_.c_str()) != 0) fail(errno, path_);
}

void EventFolder::discard() {
  const std::string partial = path_ + kPartial;
  ::unlink((partial + "/" + kTable).c_str());
  if (::rmdir(partial.c_str()) != 0 && errno != ENOENT) fail(errno, partial);
}

}  // namespace ols::recorder
