#include "sim/processes/simulated_station.h"

#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "base/process/clocks.h"
#include "edge/camera/camera_handover.h"
#include "edge/gpio/gpio_handover.h"
#include "edge/lens/lens_handover.h"
#include "edge/ptu/ptu_handover.h"
#include "edge/ptu/ptu_kind.h"

namespace ols::sim {
namespace {

constexpr std::int64_t kStepsOfTurn = 4;  // a turn of the control loop waits so long for a frame
constexpr double kTransport_s = 0.004;    // of a frame over the wire
constexpr double kStampSd_s = 20e-6;
constexpr std::uint64_t kUnitTag = 4000;

std::optional<clock::ClockReading> right_clock() {
  clock::ClockReading reading;
  reading.monotonic_s = clock_monotonic_s();
  reading.utime_us = clock_utime_us();
  reading.service = reading.synchronised = true;
  reading.estimated_error_s = 1e-5;
  reading.source = "simulation";
  return reading;
}

}  // namespace

// Its frames are published by the station's steps.
class SimulatedStation::CameraInHand : public camera::Camera {
 public:
  explicit CameraInHand(const camera::CameraConfig& config) : config_(config) {}

  std::optional<camera::Frame> next(double timeout_s) override { return handover.next(timeout_s); }
  void set_region(const std::optional<cv::Rect2d>& target_box) override {
    handover.set_region(target_box);
  }
  void trigger() override { handover.ask_trigger(); }
  device::DeviceReport report() const override {
    return camera::make_camera_report(config_, handover.facts(), clock_monotonic_s());
  }

  camera::CameraHandover handover;

 private:
  const camera::CameraConfig config_;
};

// Its bytes are moved by the station's steps.
class SimulatedStation::UnitInHand : public ptu::PtuHandover {
 public:
  explicit UnitInHand(const ptu::PtuConfig& config) : PtuHandover(config) { restart(); }

  // `plugged`: the line is there.
  void plug(bool plugged) {
    if (plugged && !link_.is_open) restart();
    if (!plugged && link_.is_open) ++link_.failures;
    link_.is_open = plugged;
  }

 private:
  device::DeviceThread::Link link() const override { return link_; }

  device::DeviceThread::Link link_{
      .is_open = true, .openings = 1, .failure = "unplugged", .fault = ""};
};

// Likewise.
class SimulatedStation::LensInHand : public lens::LensHandover {
 public:
  using LensHandover::LensHandover;

 private:
  device::DeviceReport line() const override {
    device::DeviceReport report;
    report.name = "lens";
    report.state = device::DeviceState::kOk;
    return report;
  }
};

// Its levels are those of the station's faults.
class SimulatedStation::GpioInHand : public gpio::GpioHandover {
 public:
  GpioInHand(const gpio::GpioConfig& config, OnStop on_stop, OnRearm on_rearm)
      : GpioHandover(config, std::move(on_stop), std::move(on_rearm)), config_(config) {
    opened();
  }

  void step(const StationFaults& faults) {
    lines_.set(config_.stop_line, faults.stop_pressed != config_.stop_active_low);
    lines_.set(config_.rearm_line, faults.rearm_held != config_.rearm_active_low);
    turn(lines_);
  }

 private:
  class Lines : public gpio::GpioLines {
   public:
    void set(int line, bool high) {
      const auto [level, is_new] = levels_.try_emplace(line, high);
      if (is_new || level->second != high) edges_.push_back({line, high, clock_monotonic_s()});
      level->second = high;
    }
    std::vector<int> fds() const override { return {}; }
    std::vector<gpio::LineLevel> receive() override { return std::exchange(edges_, {}); }
    void refresh() override {
      for (const auto& [line, high] : levels_) edges_.push_back({line, high, clock_monotonic_s()});
    }
    void write(int /*line*/, bool /*high*/) override {}

   private:
    std::map<int, bool> levels_;
    std::vector<gpio::LineLevel> edges_;
  };

  const gpio::GpioConfig config_;
  Lines lines_;
};

SimulatedStation::SimulatedStation(const World& world, std::size_t index,
                                   station::StationSettings settings, SimulatedTime& time)
    : world_(world),
      index_(index),
      settings_(std::move(settings)),
      unit_(world.ptu_unit_config(), derived_seed(world.seed(), kUnitTag + index),
            clock_monotonic_s()),
      exposed_(world.stations()[index].unit, world.ptu_unit_config()),
      renderer_(std::make_unique<Renderer>(
          world, index, slopes_texture(world.scenario().landscape, world.scenario().camera))) {
  const ZoomScenario& zoom = world.scenario().stations[index].zoom;
  if (!zoom.is_fixed()) {
    lens_unit_.emplace(LensUnitConfig{.zoom_travel_s = zoom.travel_s}, clock_monotonic_s());
  }
  restart();
  time.at_each_step([this](double time_s) { step(time_s); });
}

SimulatedStation::~SimulatedStation() = default;

void SimulatedStation::restart() {
  process_.reset();
  process_ = std::make_unique<station::StationProcess>(
      settings_, ++boots_,
      station::Outside{[this](const auto& settings) { return chosen(settings); }, right_clock});
}

station::ChosenDevices SimulatedStation::chosen(const station::StationSettings& settings) {
  const auto* flir = settings.mount.as<ptu::PtuKind>();
  if (flir == nullptr) {
    throw std::invalid_argument(settings.id + ": a station in simulated time has a unit of FLIR");
  }
  auto camera = std::make_unique<CameraInHand>(settings.camera->config());
  auto ptu = std::make_unique<UnitInHand>(flir->unit);
  camera_ = camera.get();
  ptu_ = ptu.get();
  station::ChosenDevices chosen;
  chosen.camera = std::move(camera);
  chosen.mount = std::move(ptu);
  lens_ = nullptr;
  inclinometer_ = nullptr;
  gnss_ = nullptr;
  gpio_ = nullptr;
  if (!settings.lens.device.empty()) {
    auto own = std::make_unique<LensInHand>(settings.lens);
    lens_ = own.get();
    chosen.lens = std::move(own);
  }
  if (settings.inclinometer->is_configured()) {
    auto own =
        std::make_unique<InclinometerInHand>(world_, index_, settings.inclinometer->config());
    inclinometer_ = own.get();
    chosen.inclinometer = std::move(own);
  }
  if (settings.gnss->is_configured()) {
    auto own = std::make_unique<GnssInHand>(world_, index_);
    gnss_ = own.get();
    chosen.gnss = std::move(own);
  }
  if (!settings.gpio.chip.empty()) {
    chosen.open_gpio = [this, config = settings.gpio](auto on_stop, auto on_rearm) {
      auto own = std::make_unique<GpioInHand>(config, std::move(on_stop), std::move(on_rearm));
      gpio_ = own.get();
      return own;
    };
  }
  return chosen;
}

void SimulatedStation::set_faults(const StationFaults& faults) {
  faults_ = faults;
  unit_.set_faults(faults.ptu, clock_monotonic_s());
}

PanTilt SimulatedStation::angles() const { return unit_.angles_at(clock_monotonic_s()); }

void SimulatedStation::step(double time_s) {
  exchange_bytes();
  if (inclinometer_) inclinometer_->step(faults_.inclinometer, clock_monotonic_s());
  if (gnss_) gnss_->step(faults_.gnss, clock_monotonic_s());
  if (gpio_) gpio_->step(faults_);
  expose(time_s);
  if (++steps_ % kStepsOfTurn == 0) process_->turn();
}

void SimulatedStation::exchange_bytes() {
  const double now_s = clock_monotonic_s();
  ptu_->plug(!unit_.line_gone());
  if (const auto halt = ptu_->take_halt()) unit_.receive(*halt, now_s);
  const auto turn = ptu_->turn(unit_.transmit(now_s));
  unit_.set_master_baud(turn.baud);
  if (!turn.request.empty()) unit_.receive(turn.request, now_s);
  if (lens_) lens_unit_->receive(lens_->turn(lens_unit_->transmit(now_s)).request, now_s);
}

void SimulatedStation::expose(double time_s) {
  const Scenario& s = world_.scenario();
  const double mid_s = static_cast<double>(exposures_) / s.frame_rate_hz;
  if (time_s < mid_s + 0.5 * s.exposure_s + s.readout_s + kTransport_s) return;
  ExposureTruth exposure;
  exposure.mid_s = mid_s;
  exposure.exposure_s = s.exposure_s;
  exposure.frame = static_cast<std::uint64_t>(exposures_++);
  exposure.by_hand = faults_.by_hand;
  const double age_s = time_s - mid_s;
  camera::Frame frame;
  frame.mid_exposure_s = clock_monotonic_s() - age_s;
  if (lens_unit_) exposure.zoom = lens_unit_->zoom_at(frame.mid_exposure_s);
  frame.stamp_sd_s = kStampSd_s;
  frame.number = exposure.frame;
  const std::int64_t utime_us = clock_utime_us() - std::llround(age_s * 1e6);
  exposed_.expose([this](double at_s) { return unit_.angles_at(at_s); }, frame.mid_exposure_s,
                  exposure);
  if (s.landscape.sun) {
    exposure.sun = sun_over(world_.stations()[index_].truth.position, utime_us);
  }
  const ViewTruth view = renderer_->draw(exposure, frame.gray);
  sent_.push_back({utime_us, exposure, view});
  statistics_.add(clock_monotonic_s(), true);
  camera_->handover.publish(std::move(frame), 0, statistics_);
}

}  // namespace ols::sim
