// Reads the images of a clip, a folder or a printf pattern in order, in grey and in colour.
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace ols::offline {

// what() is one line that names the file.
class FrameSourceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class FrameSource {
 public:
  explicit FrameSource(const std::string& input);  // throws FrameSourceError

  // The next image; nullopt at the end. Throws FrameSourceError if an image cannot be read, or if a
  // clip ends before its announced number of frames.
  std::optional<cv::Mat> next();
  // The newest image in colour: 8-bit, blue, green, red; empty if the image has no colours.
  const cv::Mat& colour() const { return colour_; }
  // The clip's frame rate; 30 if the clip does not state it.
  double frames_per_second() const { return frames_per_second_; }
  // The announced number of frames, for progress only: a clip may have a few frames less. 0:
  // unknown.
  std::size_t announced() const { return files_.empty() ? announced_ : files_.size(); }
  // The image files of a folder or pattern; empty for a clip.
  const std::vector<std::string>& files() const { return files_; }

 private:
  std::optional<cv::Mat> next_of_clip();
  std::optional<cv::Mat> next_file();

  std::string input_;
  std::vector<std::string> files_;
  cv::VideoCapture clip_;
  cv::Mat colour_;
  double frames_per_second_ = 30.0;
  std::size_t announced_ = 0;
  std::size_t read_ = 0;
};

}  // namespace ols::offline
