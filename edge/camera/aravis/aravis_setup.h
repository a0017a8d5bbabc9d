// The setup of an opened camera before it streams: image, trigger, exposure, PTP, transport. Each
// function throws CameraUnfit when the camera does not accept the configuration, CameraAbsent when
// it no longer answers.
#pragma once

#include "edge/camera/aravis/aravis_config.h"

using ArvCamera = struct _ArvCamera;

namespace ols::camera {

// Sets pixel format and size, and reads them back, because some cameras silently keep their own
// values.
void set_picture(ArvCamera* camera, const AravisConfig& config);

void set_trigger(ArvCamera* camera, const AravisConfig& config);

// Exposure and gain as configured; switches the camera's own automatic control off.
ExposureSetting set_first_exposure(ArvCamera* camera, const AravisConfig& config);

// The camera's actual values.
ExposureSetting set_exposure(ArvCamera* camera, const ExposureSetting& setting);

// The configured limits, within those of the camera.
ExposureLimits exposure_limits(ArvCamera* camera, const ExposureLimits& configured);

void set_ptp(ArvCamera* camera, const AravisConfig& config);

// Sets packet size, packet socket and packet delay. Call it after the image format is set, and
// before the stream.
void set_transport(ArvCamera* camera, const AravisConfig& config);

}  // namespace ols::camera
