// The keys of a motorised lens and of its zoom positions.
#include "edge/lens/lens_config.h"

#include <exception>

#include "base/config/config_section.h"

namespace ols::lens {
namespace {

using config::number;

std::vector<config::Row> point_rows(ZoomPoint& point) {
  CameraIntrinsics& camera = point.camera;
  return {number("position", point.position, {0.0, 1.0}, "", "Of the zoom: 0 widest, 1 longest.")
              .required(),
          number("focal_px", camera.fx_px, {1.0, 1e7}, "px", "Focal length.").required(),
          number("focal_sd_px", point.focal_sd_px, {0.0, 1e6}, "px", "Its 1-sigma.").required(),
          number("cx_px", camera.cx_px, {-1e5, 1e5}, "px", "Principal point, x.").required(),
          number("cy_px", camera.cy_px, {-1e5, 1e5}, "px", "Principal point, y.").required(),
          number("centre_sd_px", point.centre_sd_px, {0.0, 1e4}, "px",
                 "1-sigma of the principal point, each axis.")
              .required(),
          number("k1", camera.k1, {-1e3, 1e3}, "", "Radial distortion, second order."),
          number("k2", camera.k2, {-1e6, 1e6}, "", "Radial distortion, fourth order.")};
}

config::Section point_section(std::vector<ZoomPoint>& points) {
  config::Section section{"point", "The calibration at one zoom position; at least two, rising."};
  section.append = [&points] {
    ZoomPoint& point = points.emplace_back();
    return config::Section{"", "", point_rows(point), {}, [&point](ConfigTable&) {
                             point.camera.fy_px = point.camera.fx_px;
                           }};
  };
  return section;
}

}  // namespace

config::Section lens_motor_section(LensMotorConfig& c) {
  return {"lens_motor",
          "A motorised zoom lens that speaks VISCA, and its calibration over the zoom.",
          {config::text("device", c.device, "Serial device; empty: none.").required_with_section(),
           config::one_of("baud", c.baud, {9600, 19200, 38400, 115200}, "baud",
                          "Rate of the serial line."),
           number("poll_interval_s", c.poll_interval_s, {0.02, 1.0}, "s",
                  "Interval of asking for the zoom position."),
           number("position_sd", c.position_sd, {1e-5, 0.1}, "",
                  "1-sigma of the reported zoom position, backlash included.")},
          {point_section(c.points)},
          [&c](ConfigTable& table) {
            if (c.device.empty()) return;
            try {
              static_cast<void>(ZoomTable(c.points));
            } catch (const std::exception& error) {
              throw table.error("point", error.what());
            }
          }};
}

}  // namespace ols::lens
