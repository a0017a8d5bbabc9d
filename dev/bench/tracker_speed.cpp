// Google Benchmark of the whole tracker with ego-motion: a camera that turns before woods, a target
// that moves, at the sizes of the cameras in use. Time is processor time of this thread; beside
// that of all frames the median of those in which the target is believed in.
#include <benchmark/benchmark.h>

#include <opencv2/core/utility.hpp>
#include <vector>

#include "dev/bench/load.h"
#include "dev/bench/synthetic_cases.h"
#include "edge/tracker/belief.h"
#include "edge/tracker/tracker.h"
#include "tools/offline/timing_csv.h"

namespace {

constexpr int kPictures = 60;

struct Clip {
  std::vector<cv::Mat> pictures;
  cv::Rect2d box;
};

Clip make_clip(const cv::Size& size) {
  ols::bench::Landscape landscape(ols::bench::bench_camera(size));
  const ols::bench::PixelNoise noise;
  ols::tracker::Random random(1);
  ols::bench::BenchCase which;
  which.look.contrast_sigma = 0.0;
  which.pan_rate_deg_s = 2.0;
  const ols::bench::BenchPath path(which, landscape, random);
  const ols::bench::SyntheticTarget target(which.look);
  Clip clip;
  for (int frame = 0; frame < kPictures; ++frame) {
    const double time_s = frame * ols::bench::kFrameInterval_s;
    cv::Mat1f light = landscape.backdrop(ols::bench::Backdrop::kLandscape, path.camera(time_s));
    target.draw(light, path.target_px(time_s), path.smear_px(time_s), 1.0);
    clip.pictures.push_back(noise.develop(light, random));
  }
  clip.box = target.box(path.target_px(0.0));
  return clip;
}

// Forwards and backwards through the clip: it never ends. Nothing leaps, but at both ends camera
// and target turn about at once; a tracker that expects them to go on loses the target there, and
// the search for it is part of the measure.
int picture_of(int frame) {
  const int place = frame % (2 * kPictures - 2);
  return place < kPictures ? place : 2 * kPictures - 2 - place;
}

void track(benchmark::State& state, ols::tracker::TrackerMode mode) {
  const Clip clip = make_clip({static_cast<int>(state.range(0)), static_cast<int>(state.range(1))});
  ols::tracker::TrackerConfig config;
  config.mode = mode;
  ols::tracker::Tracker tracker(config, 1);
  int frame = 0;
  const auto input = [&] {
    const auto index = static_cast<std::size_t>(picture_of(frame));
    return ols::tracker::TrackerInput{
        clip.pictures[index], frame * ols::bench::kFrameInterval_s, {}};
  };
  if (tracker.initialise(input(), clip.box)) state.SkipWithError("the box is refused");
  std::vector<double> taken_ms, believed_ms;
  for ([[maybe_unused]] auto _ : state) {
    ++frame;
    const ols::tracker::TrackerInput given = input();
    const double began_s = ols::offline::thread_time_s();
    const ols::tracker::TrackerResult result = tracker.track(given);
    const double taken_s = ols::offline::thread_time_s() - began_s;
    if (!result.output) state.SkipWithError("a frame is refused");
    taken_ms.push_back(1e3 * taken_s);
    if (result.output->belief >= ols::tracker::kBelieved) believed_ms.push_back(1e3 * taken_s);
    state.SetIterationTime(taken_s);
  }
  state.counters["median_ms"] = ols::bench::quantile(taken_ms, 0.5);
  state.counters["p99_ms"] = ols::bench::quantile(taken_ms, 0.99);
  state.counters["believed"] =
      static_cast<double>(believed_ms.size()) / static_cast<double>(taken_ms.size());
  if (!believed_ms.empty())
    state.counters["median_believed_ms"] = ols::bench::quantile(believed_ms, 0.5);
}

void in_full_mode(benchmark::State& state) { track(state, ols::tracker::TrackerMode::kFull); }
void in_paper_mode(benchmark::State& state) { track(state, ols::tracker::TrackerMode::kPaper); }

void sizes(benchmark::internal::Benchmark* one) {
  one->Args({640, 512})->Args({1280, 960})->Iterations(600)->UseManualTime();
  one->Unit(benchmark::kMillisecond)->ArgNames({"width", "height"});
}

BENCHMARK(in_full_mode)->Apply(sizes);
BENCHMARK(in_paper_mode)->Apply(sizes);

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
