"""ipycam as the PTZ camera of a simulated station: ipycam takes the orders of ONVIF, and ols-sim
draws what its camera sees at ipycam's angles.

ipycam_camera.py STATION PORT USER PASSWORD PAN_DEG TILT_DEG

PAN_DEG, TILT_DEG: its angles at position 1."""

import math
import signal
import sys
import time

import ipycam
import ols_msg
from ols_demo.bus import LIVE_URL, Bus
from ols_demo.keys import members_of_environment

INTERVAL_S = 0.01  # from one statement of the angles to the next


def main(station, port, user, password, pan_deg, tilt_deg):
    config = ipycam.CameraConfig(
        local_ip="127.0.0.1", onvif_port=int(port), username=user, password=password
    )
    camera = ipycam.IPCamera(config)
    bus = Bus(LIVE_URL, lambda *_: None, members_of_environment())
    angles = ols_msg.truth_ptu_t()
    angles.station, angles.samples = station, 1
    signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGTERM})  # in ipycam's threads, too
    camera.start()
    print("ready", flush=True)
    while signal.sigtimedwait({signal.SIGTERM}, INTERVAL_S) is None:
        position = camera.ptz.state
        angles.utime = time.time_ns() // 1000
        angles.pan_rad = [math.radians(float(pan_deg) * position.pan)]
        angles.tilt_rad = [math.radians(float(tilt_deg) * position.tilt)]
        bus.publish(f"OLS_SIM_ANGLES_{station}", angles.encode())
    camera.stop()


if __name__ == "__main__":
    main(*sys.argv[1:])
