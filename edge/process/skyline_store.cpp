#include "edge/process/skyline_store.h"

#include <exception>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <variant>

#include "base/files/small_file.h"
#include "conditions/alarms.h"

namespace ols::station {
namespace {

// nullopt if there is no file. Throws std::system_error, std::runtime_error.
std::optional<skyline::SavedSkyline> read(const std::string& path) {
  constexpr std::size_t kMost = 1'000'000;  // [byte]
  try {
    auto found = skyline::saved_skyline_from(read_small_file(path, kMost));
    if (const auto* wrong = std::get_if<std::string>(&found)) {
      throw std::runtime_error(path + ": " + *wrong);
    }
    return std::get<skyline::SavedSkyline>(std::move(found));
  } catch (const std::system_error& failure) {
    if (failure.code() == std::errc::no_such_file_or_directory) return std::nullopt;
    throw;
  }
}

}  // namespace

SkylineStore::SkylineStore(const std::string& file) : path_(file), file_(file) {
  if (file.empty()) return;
  try {
    found_ = read(file);
  } catch (const std::exception& failure) {
    refused_ = alarm::saved_skyline_refused(failure.what());
  }
}

std::optional<skyline::HidingSkyline> SkylineStore::take_found(const skyline::SkylineOwner& owner) {
  const auto found = std::exchange(found_, std::nullopt);
  if (!found || found->skyline.crests.empty()) return std::nullopt;
  const std::string why = why_not_used(*found, owner);
  if (why.empty()) return found->skyline;
  refused_ = alarm::saved_skyline_refused(path_ + ": " + why);
  return std::nullopt;
}

void SkylineStore::keep(const skyline::SavedSkyline& saved, double now_s) {
  if (saved.skyline.crests.empty() || (kept_s_ && now_s - *kept_s_ < kInterval_s)) return;
  kept_s_ = now_s;
  dropped_ = false;
  refused_ = {};
  file_.write(to_text(saved));
}

void SkylineStore::drop(const skyline::SkylineOwner& owner) {
  if (std::exchange(dropped_, true)) return;
  kept_s_.reset();
  file_.write(skyline::to_text({owner, {}}));
}

Alarm SkylineStore::trouble() const {
  if (!refused_.empty()) return refused_;
  const std::string failed = file_.trouble();
  return failed.empty() ? Alarm() : alarm::skyline_unsaved(failed);
}

}  // namespace ols::station
