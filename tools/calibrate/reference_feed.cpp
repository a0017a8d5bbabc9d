#include "tools/calibrate/reference_feed.h"

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "base/files/atomic_file.h"
#include "tools/calibrate/calibrate_case.h"

namespace ols::calibration {

namespace fs = std::filesystem;

ReferenceFeed::ReferenceFeed(fs::path source, fs::path copy)
    : source_(std::move(source)), copy_(std::move(copy)) {
  references_ = references_in(source_.string());  // names the person's own file
  take();
}

// Takes whole lines only: the last one may still be in the making.
void ReferenceFeed::take() {
  std::ifstream file(source_, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(file), {});
  if (!file && text.empty()) throw std::runtime_error(source_.string() + ": cannot be read");
  size_ = text.size();
  if (const std::size_t end = text.rfind('\n'); end != std::string::npos) text.resize(end + 1);
  const fs::path next = copy_.string() + ".new";
  AtomicFile out(next.string());
  out.stream() << text;
  out.commit();
  references_ = references_in(next.string());
  fs::rename(next, copy_);
}

void ReferenceFeed::refresh() {
  std::error_code failed;
  const auto size = fs::file_size(source_, failed);
  if (!failed && size == size_) return;
  try {
    take();
    trouble_.clear();
  } catch (const std::exception& problem) {
    trouble_ = problem.what();
  }
}

std::vector<Place> ReferenceFeed::landmarks() const {
  std::vector<Place> landmarks;
  for (const auto& [name, reference] : references_) {
    const auto* point = std::get_if<FixedPoint>(&reference);
    if (point) landmarks.push_back({name, point->ecef, point->sd_m});
  }
  return landmarks;
}

Trajectory ReferenceFeed::trajectory(const std::string& name) const {
  const auto found = references_.find(name);
  const auto* trajectory =
      found == references_.end() ? nullptr : std::get_if<Trajectory>(&found->second);
  return trajectory ? *trajectory : Trajectory{};
}

}  // namespace ols::calibration
