"""The console's process and its API: state, commands' refusals, log-in, what foreigners get."""

import contextlib
import http.client
import json
import socket
import ssl
from urllib.parse import urlsplit

import pytest
from conftest import BIN, ROOT, finished, wait
from console_site import PASSWORD, Api, add_user, address_of, console_command
from ols_demo.site import Site

pytest_plugins = ["console_fixtures"]


@pytest.fixture(scope="module")
def api(paper, tmp_path_factory):
    folder = tmp_path_factory.mktemp("console")
    with Site(folder / "logs") as site:
        command = console_command(folder / "users", "--port", "0")
        site.start_and_wait("ols-console", command, "ready")
        client = Api(address_of(site, "ols-console"))
        wait(lambda: len(client.state()["stations"]) == 3, "three stations")
        yield client
        site.check()
        assert site.stop("ols-console") == 0


@pytest.fixture(scope="module")
def closed(paper, tmp_path_factory):
    """With TLS and users, on every interface."""
    folder = tmp_path_factory.mktemp("closed")
    done = finished(
        ROOT / "systemd/ols-console-certificate", folder / "tls", "localhost", check=True
    )
    config = folder / "console.toml"
    config.write_text('address = "0.0.0.0"\nport = 0\n' + done.stdout)
    add_user(folder / "users", "ana", PASSWORD, "operator")
    with Site(folder / "logs") as site:
        command = console_command(folder / "users", "--config", str(config))
        site.start_and_wait("ols-console", command, "ready")
        port = urlsplit(address_of(site, "ols-console")).port
        trust = ssl.create_default_context(cafile=str(folder / "tls/site-ca.pem"))

        def connect():
            return http.client.HTTPSConnection("localhost", port, timeout=60, context=trust)

        yield connect
        assert site.stop("ols-console") == 0


def test_the_state_is_that_of_the_bus(api):
    state = wait(
        lambda: (s := api.state())["targets"] and s["fusion"] and s, "a target and the fusion"
    )
    assert [s["id"] for s in state["stations"]] == ["alfa", "bravo", "charlie"]
    assert state["stations"][0]["latitude_deg"] == pytest.approx(49.225)
    (target,) = state["targets"]
    assert target["speed_m_s"] == pytest.approx(5.0, abs=0.01)
    assert target["course_deg"] == pytest.approx(36.87, abs=0.1)
    assert target["ellipse95"]["semi_major_m"] > target["ellipse95"]["semi_minor_m"] > 0
    status, health, _ = api.ask("/api/health")
    assert status == 200 and health["stations"] == 3 and health["fusion"]


def test_stop_needs_one_request(api, paper):
    status, said, _ = api.ask("/api/stop", {})
    assert (status, said["stopping"]) == (200, ["alfa", "bravo", "charlie"])
    stopped = {(name, "stop") for name in ("alfa", "bravo", "charlie")}
    wait(lambda: stopped <= set(paper.commands), "all to be stopped")
    wait(
        lambda: (
            sum(e["text"] == "stop" and e["outcome"] == "done" for e in api.state()["events"]) >= 3
        ),
        "their confirmations",
    )


@pytest.mark.parametrize(
    ("headers", "status"),
    [
        ({"Origin": "http://evil.example"}, 403),
        ({"Host": "evil.example"}, 403),
        ({"Content-Type": "text/plain"}, 415),
    ],
)
def test_foreign_requests_are_refused(api, headers, status):
    answered, said, _ = api.ask("/api/stop", {}, headers=headers)
    assert answered == status and said["error"]


def upgrade(address, origin):
    """The status of opening the WebSocket from a page of this origin."""
    connection = http.client.HTTPConnection(urlsplit(address).netloc, timeout=60)
    headers = {"Upgrade": "websocket", "Connection": "Upgrade", "Sec-WebSocket-Version": "13"}
    headers |= {"Sec-WebSocket-Key": "dGhlIHNhbXBsZSBub25jZQ==", "Origin": origin}
    connection.request("GET", "/api/live", headers=headers)
    status = connection.getresponse().status
    connection.close()
    return status


def test_the_web_socket_opens_for_the_own_page_only(api):
    assert upgrade(api.address, api.address) == 101
    assert upgrade(api.address, "http://evil.example") == 403


def test_what_is_too_long_or_no_http_is_refused_and_nothing_ends(api):
    assert api.ask("/api/session", b"x" * 10_000)[0] == 413
    place = urlsplit(api.address)
    for garbage in (b"\x16\x03\x01\x02\x00", b"GET /" + b"a" * 20_000, b"\0" * 100 + b"\r\n\r\n"):
        with socket.create_connection((place.hostname, place.port), timeout=60) as connection:
            connection.sendall(garbage)
            with contextlib.suppress(OSError):  # it has hung up
                connection.shutdown(socket.SHUT_WR)
                answer = connection.recv(4096)
                assert answer == b"" or answer.startswith(b"HTTP/1.1 4")
    assert api.ask("/api/health")[0] == 200


def test_what_is_served_is_compressed_and_small(api):
    size = 0
    for path in ("/", "/page.js", "/page.css", "/land.json", "/icon.svg"):
        status, content, headers = api.ask(path)
        assert status == 200 and headers["Content-Encoding"] == "gzip", path
        assert headers["Content-Security-Policy"].startswith("default-src 'self'")
        size += len(content)
    assert size <= 700_000


def test_a_log_in_over_tls(closed):
    def ask(method, path, body=None, cookie=""):
        connection = closed()
        headers = {"Content-Type": "application/json", "Cookie": cookie}
        connection.request(method, path, json.dumps(body) if body else None, headers)
        answer = connection.getresponse()
        answer.read()
        return answer

    assert ask("GET", "/api/state").status == 401
    wrong = {"name": "ana", "password": "wrong horse"}
    assert ask("POST", "/api/session", wrong).status == 401
    right = ask("POST", "/api/session", {"name": "ana", "password": PASSWORD})
    cookie = right.headers["Set-Cookie"]
    assert right.status == 200
    assert all(word in cookie for word in ("HttpOnly", "SameSite=Strict", "Secure"))
    assert ask("GET", "/api/state", cookie=cookie.split(";")[0]).status == 200
    tries = [ask("POST", "/api/session", wrong).status for _ in range(6)]
    assert tries[-1] == 429


def test_a_bad_configuration_is_refused_with_its_line(tmp_path):
    config = tmp_path / "console.toml"
    check = [str(BIN / "ols-console"), "--check-config", "--config", str(config)]
    for text, complaint in (
        ("prot = 8080\n", ":1: prot: unknown key; did you mean port?"),
        ('address = "0.0.0.0"\n', ":1: address: away from loopback it needs certificate and key"),
        ("", ""),
    ):
        config.write_text(text)
        done = finished(*check)
        assert done.returncode == (2 if complaint else 0)
        assert complaint in done.stderr


def test_a_certificate_that_cannot_be_made_says_why(tmp_path):
    done = finished(ROOT / "systemd/ols-console-certificate", tmp_path, "999.1.1.1")
    assert done.returncode != 0 and "999.1.1.1" in done.stderr


def test_a_file_of_users_that_cannot_be_read_is_bad_input(network, tmp_path):
    done = finished(*console_command(tmp_path, "--port", "0"))
    assert done.returncode == 2 and str(tmp_path) in done.stderr


def test_a_password_of_a_file_of_users_is_no_plain_text(tmp_path):
    users = tmp_path / "users"
    add_user(users, "ana", PASSWORD, "admin")
    add_user(users, "ben", PASSWORD, "viewer")
    assert PASSWORD not in users.read_text()
    assert users.read_text().count("$argon2id$") == 2
    assert users.stat().st_mode & 0o077 == 0
    done = finished(BIN / "ols-console", "--users", users, "--add-user", "eve", input="short\n")
    assert done.returncode == 2 and "8 to 200" in done.stderr
