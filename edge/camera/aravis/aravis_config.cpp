#include "edge/camera/aravis/aravis_config.h"

#include <algorithm>
#include <iterator>

namespace ols::camera {
namespace {

using config::Row;
using Rows = std::vector<Row>;

Rows image_rows(AravisConfig& c) {
  Rows rows{config::text("device", c.device,
                         "Aravis id, as arv-tool-0.8 lists it, or IPv4 address of the camera.",
                         config::not_empty)
                .required()};
  std::ranges::move(picture_rows(c), std::back_inserter(rows));
  return rows;
}

Rows trigger_rows(AravisConfig& c) {
  return {
      config::word(
          "trigger", c.trigger,
          {{"fixed-rate", TriggerMode::kFixedRate},
           {"free-run", TriggerMode::kFreeRun},
           {"software", TriggerMode::kSoftware},
           {"line1", TriggerMode::kLine1},
           {"line2", TriggerMode::kLine2},
           {"line3", TriggerMode::kLine3},
           {"line4", TriggerMode::kLine4}},
          "What starts an exposure: the camera's timer, itself at its maximum rate, the station, "
          "or a pulse on an input."),
      config::choice("trigger_activation", c.trigger_activation,
                     {"rising-edge", "falling-edge", "any-edge"},
                     "Edge of the input line that triggers."),
      config::number("trigger_delay_us", c.trigger_delay_us, {0.0, 1e7}, "us",
                     "Delay from the trigger to the exposure."),
  };
}

Rows exposure_rows(AravisConfig& c) {
  ExposureLimits& l = c.limits;
  return {
      config::number("exposure_us", c.exposure_us, {1.0, 1e7}, "us",
                     "Exposure time; automatic exposure starts from it."),
      config::number("gain_dB", c.gain_dB, {0.0, 60.0}, "dB",
                     "Gain; automatic exposure starts from it."),
      config::flag("auto_exposure", c.auto_exposure,
                   "Adapts the exposure, then the gain, to the target or to the whole image."),
      config::number("exposure_min_us", l.exposure_min_us, {1.0, 1e7}, "us",
                     "Minimum of automatic exposure."),
      config::number("exposure_max_us", l.exposure_max_us, {1.0, 1e7}, "us",
                     "Maximum of automatic exposure: what motion blur allows."),
      config::number("gain_min_dB", l.gain_min_dB, {0.0, 60.0}, "dB",
                     "Minimum gain of automatic exposure."),
      config::number("gain_max_dB", l.gain_max_dB, {0.0, 60.0}, "dB",
                     "Maximum gain of automatic exposure."),
      config::number("auto_bright_level", c.auto_levels.bright_level, {50.0, 245.0}, "gray level",
                     "Goal for the brighter of target and surround."),
      config::number("auto_mean_level", c.auto_levels.mean_level, {20.0, 200.0}, "gray level",
                     "Goal for the mean of the image without a target."),
      config::integer("auto_settle_frames", c.auto_levels.settle_frames, 1, 1000, "frames",
                      "Frames from a change until the camera's images show it."),
  };
}

Rows time_rows(AravisConfig& c) {
  return {
      config::word(
          "stamp_at", c.stamp_at,
          {{"exposure-start", StampAt::kExposureStart}, {"exposure-end", StampAt::kExposureEnd}},
          "Instant that the camera's time stamp marks; differs by model."),
      config::number("readout_s", c.readout_s, {0.0, 1.0}, "s",
                     "From the end of the exposure to the arrival of the first packet; used while "
                     "the camera's clock cannot be read."),
      config::number("readout_sd_s", c.readout_sd_s, {1e-6, 1.0}, "s", "1-sigma of readout_s."),
      config::choice("ptp", c.ptp, {"off", "slave", "auto"},
                     "Whether the camera's clock follows a PTP master."),
      config::integer("tai_minus_utc_s", c.tai_minus_utc_s, 30, 60, "s",
                      "Leap seconds, where the kernel does not know them."),
      config::number("ptp_sd_s", c.ptp_sd_s, {1e-9, 1.0}, "s",
                     "1-sigma of the PTP master and the path to it."),
  };
}

Rows transport_rows(AravisConfig& c) {
  return {
      config::integer("packet_size", c.packet_size, 0, 65535, "byte",
                      "IP packet size of the stream; 0: as large as the network path allows."),
      config::flag("packet_socket", c.packet_socket,
                   "Receives through the kernel's packet ring; needs CAP_NET_RAW."),
      config::integer("socket_buffer", c.socket_buffer, 65536, 1 << 30, "byte",
                      "Receive buffer to ask for; the kernel grants up to net.core.rmem_max."),
      config::number("packet_delay_us", c.packet_delay_us, {-1.0, 1e6}, "us",
                     "Pause between two packets; -1: automatic, none if the receive buffer holds "
                     "three frames."),
      config::number("packet_spread", c.packet_spread, {0.05, 0.9}, "frame periods",
                     "Duration of a frame's packets with an automatic pause."),
      config::flag("packet_resend", c.packet_resend, "Asks the camera to send lost packets again."),
  };
}

void check(ConfigTable& table, const AravisConfig& c) {
  if (c.limits.exposure_max_us < c.limits.exposure_min_us)
    throw table.error("exposure_max_us", "must not be less than exposure_min_us");
  if (c.limits.gain_max_dB < c.limits.gain_min_dB)
    throw table.error("gain_max_dB", "must not be less than gain_min_dB");
  if (c.packet_size != 0 && c.packet_size < 576)
    throw table.error("packet_size", "must be 0 (automatic) or 576..65535");
  if (c.packet_delay_us < 0.0 && c.packet_delay_us != -1.0)
    throw table.error("packet_delay_us", "must be -1 (automatic) or 0..1e6");
}

}  // namespace

config::Section aravis_section(AravisConfig& c) {
  Rows rows;
  for (auto* part : {image_rows, trigger_rows, exposure_rows, time_rows, transport_rows})
    std::ranges::move(part(c), std::back_inserter(rows));
  return {"camera", "", rows, {}, [&c](ConfigTable& table) { check(table, c); }};
}

}  // namespace ols::camera
