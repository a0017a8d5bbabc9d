#include "edge/frames/frame_post.h"

#include <opencv2/imgcodecs.hpp>

#include "base/process/time_source.h"
#include "edge/device/behind_control_loop.h"

namespace ols::station {
namespace {

constexpr std::size_t kMostWaiting = 3;

std::vector<std::uint8_t> encoded(const RequestedFrame& frame) {
  std::vector<std::uint8_t> file;
  // Level 1: a third of the time of the usual one, and hardly larger.
  if (frame.request.lossless) {
    cv::imencode(".png", frame.frame.gray, file, {cv::IMWRITE_PNG_COMPRESSION, 1});
  } else {
    cv::imencode(".jpg", frame.frame.gray, file, {cv::IMWRITE_JPEG_QUALITY, 95});
  }
  return file;
}

}  // namespace

FramePost::FramePost() : thread_([this](const std::stop_token& stop) { work(stop); }) {}

bool FramePost::put(RequestedFrame frame) {
  const std::lock_guard lock(mutex_);
  if (waiting_.size() + done_.size() >= kMostWaiting) return false;
  waiting_.push_back(std::move(frame));
  arrived_.notify_one();
  return true;
}

std::optional<EncodedFrame> FramePost::take() {
  std::unique_lock lock(mutex_);
  encoded_.wait_for(lock, time_source().for_work(),
                    [this] { return waiting_.empty() || !done_.empty(); });
  if (done_.empty()) return std::nullopt;
  EncodedFrame frame = std::move(done_.front());
  done_.pop_front();
  return frame;
}

void FramePost::work(const std::stop_token& stop) {
  device::go_behind_control_loop();
  std::unique_lock lock(mutex_);
  while (arrived_.wait(lock, stop, [this] { return !waiting_.empty(); })) {
    // It counts as waiting until it is done.
    RequestedFrame frame = waiting_.front();
    lock.unlock();
    std::vector<std::uint8_t> file = encoded(frame);
    lock.lock();
    waiting_.pop_front();
    done_.push_back({std::move(frame), std::move(file)});
    encoded_.notify_one();
  }
}

}  // namespace ols::station
