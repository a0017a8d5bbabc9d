// How an opened camera is set up before it streams: picture, trigger, exposure, PTP, transport.
// Each throws CameraUnfit when the camera does not take what is configured, CameraAbsent when it no
// longer answers.
#pragma once

#include "edge/camera/camera_config.h"

using ArvCamera = struct _ArvCamera;

namespace ols::camera {

// Pixel format and size. Read back: some cameras take a value without a word and keep their own.
void set_picture(ArvCamera* camera, const CameraConfig& config);

void set_trigger(ArvCamera* camera, const CameraConfig& config);

// Exposure and gain as configured, the camera's own automatic control switched off.
ExposureSetting set_first_exposure(ArvCamera* camera, const CameraConfig& config);

// What the camera made of it.
ExposureSetting set_exposure(ArvCamera* camera, const ExposureSetting& setting);

// The configured limits as far as the camera goes.
ExposureLimits exposure_limits(ArvCamera* camera, const ExposureLimits& configured);

void set_ptp(ArvCamera* camera, const CameraConfig& config);

// Packet size, packet socket and the pace of the packets; after the picture's format, before the
// stream.
void set_transport(ArvCamera* camera, const CameraConfig& config);

}  // namespace ols::camera
