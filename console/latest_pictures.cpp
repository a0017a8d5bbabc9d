#include "console/latest_pictures.h"

#include <utility>

#include "console/picture_bytes.h"

namespace ols::console {
namespace {

constexpr std::int64_t kVideoIsAlive_us = 3'000'000;

// Video frames are larger and more frequent; the preview is for stations without video.
bool is_preview_beside_video(const Picture& picture, const Picture& newest) {
  if (picture.is_video || !newest.is_video) return false;
  return utime_us(picture) - utime_us(newest) < kVideoIsAlive_us;
}

}  // namespace

void LatestPictures::receive(Picture picture) {
  if (picture.codec == Codec::kH264) {
    streams_[picture.station].add(picture, ++numbers_);
    return;
  }
  Kept& kept = kept_[picture.station];
  if (is_preview_beside_video(picture, kept.picture)) return;
  kept.number = ++numbers_;
  kept.picture = std::move(picture);
}

// Null: this browser is to see single pictures, because it wants them, or because the station's
// stream has ended.
const UnitChain* LatestPictures::stream_for(const View& view, const std::string& station) const {
  if (view.codec != Codec::kH264) return nullptr;
  const auto stream = streams_.find(station);
  if (stream == streams_.end() || stream->second.newest() == 0) return nullptr;
  const auto kept = kept_.find(station);
  const bool is_over =
      kept != kept_.end() &&
      utime_us(kept->second.picture) - stream->second.newest_utime_us() >= kVideoIsAlive_us;
  return is_over ? nullptr : &stream->second;
}

std::uint64_t LatestPictures::number_for(const View& view, const std::string& station) const {
  if (const UnitChain* stream = stream_for(view, station)) return stream->newest();
  const auto kept = kept_.find(station);
  return kept == kept_.end() ? 0 : kept->second.number;
}

std::optional<std::string> LatestPictures::next(View& view) const {
  const std::string* next = nullptr;
  for (const std::string& station : view.watched) {
    const std::uint64_t number = number_for(view, station);
    if (number == 0 || view.sent[station] >= number || !view.under_way.may(station)) continue;
    if (next == nullptr || view.sent[station] < view.sent[*next]) next = &station;
  }
  if (next == nullptr) return std::nullopt;
  view.under_way.sent(*next);
  const std::uint64_t had = std::exchange(view.sent[*next], number_for(view, *next));
  if (const UnitChain* stream = stream_for(view, *next)) return stream->message_after(had);
  const Picture& picture = kept_.at(*next).picture;
  return message_bytes(picture.header, picture.bytes);
}

void LatestPictures::keep_only(const std::function<bool(const std::string&)>& is_known) {
  const auto is_gone = [&](const auto& one) { return !is_known(one.first); };
  std::erase_if(kept_, is_gone);
  std::erase_if(streams_, is_gone);
}

const Picture* LatestPictures::newest(const std::string& station) const {
  const auto kept = kept_.find(station);
  return kept == kept_.end() ? nullptr : &kept->second.picture;
}

std::map<std::string, Picture> LatestPictures::newest() const {
  std::map<std::string, Picture> pictures;
  for (const auto& [station, kept] : kept_) pictures.emplace(station, kept.picture);
  return pictures;
}

void LatestPictures::show(const std::map<std::string, Picture>& pictures) {
  kept_.clear();
  for (const auto& [station, picture] : pictures) kept_[station] = {picture, ++numbers_};
}

}  // namespace ols::console
