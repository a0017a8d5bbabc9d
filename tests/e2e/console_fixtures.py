"""Fixtures of the console's tests: `pytest_plugins = ["console_fixtures"]`."""

import pytest
from conftest import wait
from console_page import two_consoles, watched_page
from console_site import Api, browser, paper_site


@pytest.fixture(scope="module")
def paper(network):
    with paper_site() as site:
        yield site


@pytest.fixture(scope="module")
def consoles(paper, tmp_path_factory):
    """Addresses of two consoles of the paper site: of one that is open, of one with users."""
    with two_consoles(tmp_path_factory.mktemp("console")) as addresses:
        yield addresses


@pytest.fixture(scope="module")
def chromium():
    with browser() as started:
        yield started


@pytest.fixture
def idle(consoles, paper):
    """Makes the stations idle; the consoles know it then."""
    console = Api(consoles[0])

    def is_known():
        paper.begin_anew()  # again: a command of the page before may still come
        return {station["state"] for station in console.state()["stations"]} == {"idle"}

    return lambda: wait(is_known, "the stations")


@pytest.fixture
def page(chromium, consoles, idle):
    """The open console's; its stations are idle."""
    idle()
    with watched_page(chromium, consoles[0]) as opened:
        yield opened


@pytest.fixture
def overview(paper):
    """charlie has a motorised lens."""
    paper.lenses["charlie"] = [0.3, 0.5, 0.7]
    paper.lens_commands.clear()
    yield paper
    paper.lenses.clear()
