"""A guided calibration in the console's page: a real browser, and a procedure that exists only as
messages."""

import itertools
import threading
import time

import lcm
import ols_msg
import pytest
from conftest import wait
from console_site import DEADLINE_S, FULL_PX, address_of, browser, console_command, jpeg, paper_site
from ols_demo.bus import LIVE_URL
from ols_demo.keys import members_of_environment
from ols_demo.site import Site
from playwright.sync_api import expect

M = ols_msg.procedure_t
expect.set_options(timeout=DEADLINE_S * 1000)


class PaperProcedure(threading.Thread):
    """Says its state five times a second, and hears what it is answered."""

    def __init__(self):
        super().__init__(daemon=True)
        self.lcm, self._signing = lcm.LCM(LIVE_URL), members_of_environment()
        self._sequences = itertools.count(
            1_000_000
        )  # the paper station of the same name counts, too
        self.answers: list[ols_msg.procedure_answer_t] = []
        self.lcm.subscribe("OLS_PROCEDURE_ANSWER_alfa", self._answered)
        self.crosshair = None
        self.choices = ["point", "exactly", "turn", "skip"]
        self.question = 1
        self.state = M.STATE_ASKING
        self._over = threading.Event()
        self._jpeg = jpeg()

    def _answered(self, _channel, data):
        self.answers.append(ols_msg.procedure_answer_t.decode(data))

    def _send(self):
        m = M()
        m.utime = time.time_ns() // 1000
        m.schema_version, m.station, m.boot_id = m.SCHEMA_VERSION, "alfa", 5
        m.sequence = next(self._sequences)
        m.procedure, m.state, m.step, m.progress = "field", self.state, "spire: where is it?", 0.4
        m.question = self.question
        m.text = "Point at spire; or turn the unit, if it is not in the picture.\nNot measured: x"
        m.choice, m.choices = list(self.choices), len(self.choices)
        m.has_crosshair = self.crosshair is not None
        m.crosshair_px = list(self.crosshair or (0.0, 0.0))
        m.full_width_px, m.full_height_px = FULL_PX
        m.scale, m.jpeg_bytes, m.jpeg = 0.25, len(self._jpeg), self._jpeg
        self.lcm.publish("OLS_PROCEDURE_alfa", self._signing.sign("OLS_PROCEDURE_alfa", m.encode()))

    def run(self):
        due = 0.0
        while not self._over.is_set():
            while self.lcm.handle_timeout(20) > 0:
                pass
            if time.monotonic() >= due:
                due = time.monotonic() + 0.2
                self._send()

    def end(self):
        self._over.set()
        self.join()


@pytest.fixture(name="procedure")
def fixture_procedure(network):
    procedure = PaperProcedure()
    with paper_site():
        procedure.start()
        yield procedure
        procedure.end()


@pytest.fixture(name="panel")
def fixture_panel(procedure, tmp_path):
    """The page's part that shows the procedure."""
    with Site(tmp_path / "logs") as site, browser() as chromium:
        site.start_and_wait("open", console_command(tmp_path / "nobody", "--port", "0"), "ready")
        address = address_of(site, "open")
        page = chromium.new_page(viewport={"width": 1280, "height": 720}, locale="en-GB")
        page.set_default_timeout(DEADLINE_S * 1000)
        page.goto(address)
        yield page.get_by_role("region", name="Calibration", exact=True)


def answer_after(procedure, count):
    wait(lambda: len(procedure.answers) > count, "an answer")
    return procedure.answers[count]


def test_a_person_points_confirms_turns_and_aborts(procedure, panel):
    expect(panel).to_contain_text("field: spire: where is it?")
    expect(panel).to_contain_text("or turn the unit, if it is not in the picture.")
    image = panel.get_by_role("img", name="spire: where is it?")
    wait(lambda: image.evaluate("image => image.naturalWidth") == 320, "its picture")
    for answer in ("Abort", "Skip", "Exactly here", "Turn by"):
        button = panel.get_by_role("button", name=answer)
        expect(button, "without scrolling").to_be_in_viewport(ratio=1)
    box = image.bounding_box()
    image.click(position={"x": box["width"] / 2, "y": box["height"] / 4})
    pointed = answer_after(procedure, 0)
    assert (pointed.choice, pointed.question, bool(pointed.has_pixel)) == ("point", 1, True)
    assert abs(pointed.pixel_px[0] - FULL_PX[0] / 2) < 6
    assert abs(pointed.pixel_px[1] - FULL_PX[1] / 4) < 6

    procedure.crosshair, procedure.question = (640.0, 240.0), 2
    procedure.choices = ["confirm", "point", "exactly", "turn", "skip"]
    expect(panel.get_by_role("img", name="crosshair at 640.0, 240.0")).to_be_visible()
    panel.get_by_role("button", name="Confirm", exact=True).click()
    confirmed = answer_after(procedure, 1)
    assert (confirmed.choice, confirmed.question) == ("confirm", 2)

    procedure.question = 3
    form = panel.locator("form", has=panel.page.get_by_role("button", name="Turn by"))
    form.get_by_label("Pan °").fill("-3.5")
    form.get_by_label("Tilt °").fill("0.5")
    # Not before the third question stands on the page: an answer to the second is refused.
    wait(
        lambda: (
            form.get_by_role("button").click() or any(a.question == 3 for a in procedure.answers)
        ),
        "an answer to the third question",
    )
    turned = next(answer for answer in procedure.answers if answer.question == 3)
    assert (turned.choice, list(turned.turn_deg)) == ("turn", [-3.5, 0.5])

    panel.page.get_by_label("Language").select_option("de")
    german = panel.page.get_by_role("region", name="Kalibrierung", exact=True)
    expect(german).to_contain_text("im Feld: spire: wo ist es?")
    expect(german).to_contain_text("oder die Einheit drehen, wenn es nicht im Bild ist.")
    expect(german).to_contain_text("Nicht gemessen: x")
    panel.page.get_by_label("Sprache").select_option("en")

    panel.get_by_role("button", name="Abort").click()
    panel.get_by_role("group", name="Abort?").get_by_role("button", name="Abort").click()
    wait(lambda: any(a.choice == "abort" for a in procedure.answers), "the abort")
    procedure.state, procedure.question, procedure.choices = M.STATE_ABORTED, 0, []
    expect(panel.get_by_role("button", name="Confirm", exact=True)).to_have_count(0)
