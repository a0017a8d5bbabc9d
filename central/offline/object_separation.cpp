#include "central/offline/object_separation.h"

#include <algorithm>
#include <set>
#include <tuple>
#include <vector>

#include "central/fusion/track_intake.h"
#include "central/tracking/live_tracks.h"

namespace ols::fusion {
namespace {

auto exposure(const BearingMeasurement* m) { return std::tie(m->utime_us, m->station); }

auto exposure_and_direction(const BearingMeasurement* m) {
  return std::tie(m->utime_us, m->station, m->sight.direction.azimuth_rad,
                  m->sight.direction.elevation_rad);
}

MutableBearings in_order(const MutableBearings& measurements) {
  MutableBearings ordered = measurements;
  std::ranges::stable_sort(ordered, {}, exposure_and_direction);
  return ordered;
}

class Separation {
 public:
  Separation(const FusionConfig& config, const MutableBearings& ordered)
      : tracks_(config.tracks),
        pointing_(config.pointing),
        ordered_(ordered),
        labels_(ordered.size(), 0) {}

  // Adds the image that begins with this bearing; returns the index of the next image's first.
  std::size_t add_image(std::size_t first) {
    std::vector<BearingMeasurement> image;
    std::size_t next = first;
    do {
      image.push_back(*ordered_[next++]);
    } while (next < ordered_.size() && exposure(ordered_[next]) == exposure(ordered_[first]));
    tracks_.advance(image.front().utime_us);
    const std::vector<Associated> fates = associate(image, tracks_, pointing_);
    for (std::size_t i = first; i < next; ++i) {
      const Association& result = fates[i - first].result;
      labels_[i] = result.kind == Association::Kind::kTrack ? result.track_id : 0;
    }
    label_new_tracks(next - 1);
    return next;
  }

  // The identity of the object of a bearing; 0: none.
  std::int64_t object_of(std::size_t index) const {
    std::int64_t label = labels_[index];
    for (const auto& [stays, other] : merged_) label = label == other ? stays : label;
    return label;
  }

 private:
  void label_new_tracks(std::size_t index) {
    for (const auto& merged : tracks_.take_merged()) merged_.push_back(merged);
    if (tracks_.counts().confirmed == confirmed_) return;
    confirmed_ = tracks_.counts().confirmed;
    for (const Track& track : tracks_.tracks()) {
      if (is_established(track) && labelled_.insert(track.id).second) label_all_of(track, index);
    }
  }

  // A track that becomes confirmed has bearings from when it had no identity yet.
  void label_all_of(const Track& track, std::size_t newest) {
    for (const auto& [station, bearings] : track.bearings) {
      auto own = bearings.rbegin();
      for (std::size_t i = newest + 1; i-- > 0 && own != bearings.rend();) {
        const BearingMeasurement& candidate = *ordered_[i];
        while (own != bearings.rend() && own->utime_us > candidate.utime_us) ++own;
        if (own == bearings.rend() || candidate.station != station ||
            exposure_and_direction(&candidate) != exposure_and_direction(&*own))
          continue;
        labels_[i] = track.id;
        ++own;
      }
    }
  }

  LiveTracks tracks_;
  PointingMonitor pointing_;
  const MutableBearings& ordered_;
  std::vector<std::int64_t> labels_;
  std::int64_t confirmed_ = 0;
  std::set<std::int64_t> labelled_;
  LiveTracks::Merged merged_;
};

}  // namespace

bool shows_several_objects(const MutableBearings& measurements) {
  const MutableBearings ordered = in_order(measurements);
  const auto differ = [](const BearingMeasurement* a, const BearingMeasurement* b) {
    return a->utime_us == b->utime_us && a->station == b->station &&
           exposure_and_direction(a) != exposure_and_direction(b);
  };
  return std::ranges::adjacent_find(ordered, differ) != ordered.end();
}

SeparatedBearings separate_objects(const MutableBearings& measurements, const FusionConfig& config,
                                   const std::function<void()>& tell) {
  SeparatedBearings separated;
  MutableBearings ordered = in_order(measurements);
  separated.low_belief = std::erase_if(ordered, [&](const BearingMeasurement* m) {
    return m->belief < config.admission.min_belief;
  });
  // Not std::ranges::unique: clang 14 does not compile the range that it returns.
  const auto doubled = std::unique(ordered.begin(), ordered.end(),
                                   [](const BearingMeasurement* a, const BearingMeasurement* b) {
                                     return exposure_and_direction(a) == exposure_and_direction(b);
                                   });
  separated.duplicate = static_cast<std::size_t>(ordered.end() - doubled);
  ordered.erase(doubled, ordered.end());
  Separation separation(config, ordered);
  for (std::size_t i = 0; i < ordered.size();) {
    const std::size_t next = separation.add_image(i);
    for (; i < next; ++i) {
      if (tell) tell();
    }
  }
  for (std::size_t i = 0; i < ordered.size(); ++i) {
    const std::int64_t object = separation.object_of(i);
    if (object == 0) {
      ++separated.unexplained;
    } else {
      separated.objects[object].push_back(ordered[i]);
    }
  }
  return separated;
}

}  // namespace ols::fusion
