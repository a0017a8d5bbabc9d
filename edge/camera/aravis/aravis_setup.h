// Configures an opened camera before it streams: image, trigger, exposure, PTP, transport. Each
// function throws CameraUnfit if the camera does not accept the configuration, and CameraAbsent if
// the camera no longer answers.
#pragma once

#include "edge/camera/aravis/aravis_config.h"

using ArvCamera = struct _ArvCamera;

namespace ols::camera {

// Sets pixel format and size. Reads both back, because some cameras silently keep their old values.
void set_picture(ArvCamera* camera, const AravisConfig& config);

void set_trigger(ArvCamera* camera, const AravisConfig& config);

// Sets exposure and gain as configured, and switches off the camera's own automatic control.
// Returns the camera's actual values.
ExposureSetting set_first_exposure(ArvCamera* camera, const AravisConfig& config);

// Returns the camera's actual values.
ExposureSetting set_exposure(ArvCamera* camera, const ExposureSetting& setting);

// Returns the configured limits, narrowed to those of the camera.
ExposureLimits exposure_limits(ArvCamera* camera, const ExposureLimits& configured);

void set_ptp(ArvCamera* camera, const AravisConfig& config);

// Sets packet size, packet socket and packet delay. Call it after the image format is set, and
// before the stream starts.
void set_transport(ArvCamera* camera, const AravisConfig& config);

}  // namespace ols::camera
