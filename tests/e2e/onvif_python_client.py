"""What onvif-python, a client of other authors, makes of a camera: HOST PORT USER PASSWORD; its
findings as JSON. A program of its own, because its package has the name of onvif-zeep's."""

import json
import sys
import time

from onvif import CacheMode, ONVIFClient

NEAR = 0.006
DEADLINE_S = 20.0


def position(ptz, profile):
    """Where it rests; None: it moves."""
    status = ptz.GetStatus(profile)
    if status.MoveStatus.PanTilt != "IDLE":
        return None
    return status.Position.PanTilt.x, status.Position.PanTilt.y


def goes_to(ptz, profile, x, y):
    ptz.AbsoluteMove(profile, {"PanTilt": {"x": x, "y": y}})
    end = time.monotonic() + DEADLINE_S
    while time.monotonic() < end:
        at = position(ptz, profile)
        if at is not None and abs(at[0] - x) < NEAR and abs(at[1] - y) < NEAR:
            return True
        time.sleep(0.05)
    return False


def main(host, port, user, password):
    camera = ONVIFClient(host, int(port), user, password, cache=CacheMode.NONE)
    media, media2, ptz = camera.media(), camera.media2(), camera.ptz()
    (old,) = media.GetProfiles()
    (new,) = media2.GetProfiles(Type=["All"])
    encoder = new.Configurations.VideoEncoder
    found = {
        "model": camera.devicemgmt().GetDeviceInformation().Model,
        "tokens": [old.token, new.token],
        "encodings": [old.VideoEncoderConfiguration.Encoding, encoder.Encoding],
        "width": encoder.Resolution.Width,
        "ptz": new.Configurations.PTZ.NodeToken == ptz.GetNodes()[0].token,
        "stream": str(media2.GetStreamUri("RTSP", new.token)),
        "goes": goes_to(ptz, new.token, 0.05, -0.2),
    }
    ptz.ContinuousMove(new.token, {"PanTilt": {"x": -0.05, "y": 0.0}}, "PT60S")
    ptz.Stop(new.token, PanTilt=True)
    print(json.dumps(found))


main(*sys.argv[1:])
