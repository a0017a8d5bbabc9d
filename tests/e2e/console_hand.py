"""A person at the console's page, with a simulated site behind it: draws a box on a station's
picture, looks at what is in it. The simulator says where the object is in each frame."""

from console_page import SwiftMouse
from ols_demo.observer import Observer
from ols_demo.operator import Operator

MARGIN = 0.3  # of the object's size around it
LEAST_MARGIN_PX = 4.0  # nobody draws closer
AT_REST_RAD_S = 0.005
MOTION_US = 150_000  # over which its motion in the picture is seen
AWAY_PX = 60.0  # more than a hand shakes


class Views(Observer):
    """Also remembers where the object was in each frame."""

    def __init__(self):
        super().__init__()
        self.frames = {}  # station -> stamp -> (visible, box in the full frame [px])

    def receive(self, channel, message):
        super().receive(channel, message)
        if not channel.startswith("OLS_SIM_VIEW_"):
            return
        frames = self.frames.setdefault(message.station, {})
        frames[message.stamp_utime] = (message.visible, list(message.box_px))
        if len(frames) > 300:
            del frames[next(iter(frames))]

    def box_at(self, station, utime_us):
        """In the frame of this time, by the station's clock; None without an object."""
        frames = self.frames.get(station, {})
        stamp = min(frames, key=lambda one: abs(one - utime_us), default=None)
        if stamp is None or abs(stamp - utime_us) > 30_000 or not frames[stamp][0]:
            return None
        return frames[stamp][1]


class Pointer(Operator):
    """Points the stations like the demo's operator, and leaves the designation to the browser."""

    def _designate(self, station):
        pass

    def _aim_once(self, station):
        if self._observer.state(station) != "tracking":
            self._attend(station)

    def begin_again(self, station):
        """With a station that has tracked, or that it has pointed once."""
        self.tracking.discard(station)
        self._pointed.pop(station, None)


class Hand:
    """Leads a moving object, as a person does: between the look at a picture and the press the next
    ones come."""

    def __init__(self, page, views, bus, operator):
        self._page, self._views, self._bus, self._operator = page, views, bus, operator
        self._mouse = SwiftMouse(page)
        self._lag_us = 100_000.0  # from the picture that was looked at to the pressed one

    def turn(self, *stations):
        self._bus.handle(0.02)
        self._operator.act(set(stations))

    def state(self, station):
        self.turn(station)
        return self._views.state(station)

    def _canvas(self, station):
        return self._page.get_by_role("img", name=station, exact=True)

    def _seen_utime_us(self, station):
        return int(self._canvas(station).get_attribute("data-utime-us") or 0)

    def _on_page(self, station, x, y):
        place = self._canvas(station).bounding_box()
        status = self._views.status[station]
        across = place["x"] + x / status.image_width_px * place["width"]
        return across, place["y"] + y / status.image_height_px * place["height"]

    def _shown(self, station):
        """Where the object will be in the picture that a press holds, and the time of the one that
        is shown; None while it turns."""
        self.turn(station)
        seen_us = self._seen_utime_us(station)
        box = self._views.box_at(station, seen_us)
        before = self._views.box_at(station, seen_us - MOTION_US)
        if box is None or self._views.turning_rad_s.get(station, 1.0) > AT_REST_RAD_S:
            return None
        x, y = box[:2]
        if before is not None:
            x += (x - before[0]) * self._lag_us / MOTION_US
            y += (y - before[1]) * self._lag_us / MOTION_US
        return [x, y, *box[2:]], seen_us

    def _pressed(self, station, seen_us):
        """The object's box in the picture that the press holds."""
        pressed_us = self._seen_utime_us(station)
        self._lag_us += 0.3 * (pressed_us - seen_us - self._lag_us)
        return self._views.box_at(station, pressed_us)

    def draw(self, station):
        """True when the box was drawn around the object of the picture on which it was begun."""
        shown = self._shown(station)
        if shown is None:
            return False
        (left, upper, width, height), seen_us = shown
        beside, above = (max(LEAST_MARGIN_PX, MARGIN * size) for size in (width, height))
        left, upper = left - beside, upper - above
        began = self._on_page(station, left, upper)
        self._mouse.press(*began)
        self._mouse.move(*self._on_page(station, left + AWAY_PX, upper + AWAY_PX))
        held = self._pressed(station, seen_us)
        is_around = held is not None and (
            0 <= held[0] - left <= 2 * beside and 0 <= held[1] - upper <= 2 * above
        )
        if is_around:
            x, y, width, height = held
            self._mouse.move(*self._on_page(station, x + width + beside, y + height + above))
        else:  # there and back: no box, and no click, which would turn the unit
            self._mouse.move(*began)
        self._mouse.let_go()
        return is_around
