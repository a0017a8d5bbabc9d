"""What ols-archive makes of a bridge's stream, without a server: channels, and how far it is."""

import pytest
from ols_archive.__main__ import main
from ols_archive.streams import Position, Server, channel_of

SERVER = Server("nats://127.0.0.1:4222", domain="hub")


@pytest.mark.parametrize(
    ("subject", "channel"),
    [
        ("ols.v1.moravia.airfield.alfa.bearing", "OLS_BEARING_alfa"),
        ("ols.v1.moravia.airfield.al-f_a.status", "OLS_STATUS_al-f_a"),
        ("ols.v1.moravia.target", "OLS_TARGET"),
        ("ols.v1.moravia.airfield.alfa.cmd.slew", None),
        ("ols.v2.moravia.target", None),
        ("ols.v1.moravia.airfield.al.fa.bearing", None),
        ("ols.v1.moravia.airfield.target", None),
    ],
)
def test_the_channel_of_a_subject(subject, channel):
    assert channel_of(subject) == channel


def test_a_stream_goes_on_where_it_was_and_a_new_one_begins_anew(tmp_path):
    position = Position(tmp_path, "brno", SERVER, "OLS_brno")
    assert position.read("monday") == 0
    position.write("monday", 12)
    assert position.read("monday") == 12
    assert position.read("tuesday") == 0, "another stream of that name"
    for other in (
        Position(tmp_path, "wien", SERVER, "OLS_brno"),
        Position(tmp_path, "brno", Server(SERVER.url, domain="s"), "OLS_brno"),
        Position(tmp_path, "brno", SERVER, "OLS_brno_s"),
    ):
        assert other.read("monday") == 0


@pytest.mark.parametrize("text", ["", "{", "[]", '{"created": "monday"}', '{"sequence": 3}', "7"])
def test_a_damaged_position_is_none(tmp_path, text):
    position = Position(tmp_path, "brno", SERVER, "OLS_brno")
    position.write("monday", 12)
    (file,) = (tmp_path / ".streams").iterdir()
    file.write_text(text)
    assert position.read("monday") == 0


@pytest.mark.parametrize(
    "words", [["--stream", "OLS_r", "a.lcmlog"], ["--stream", "OLS_r", "--live", "memq://"]]
)
def test_there_is_one_source(tmp_path, words, capsys):
    with pytest.raises(SystemExit) as ended:
        main([str(tmp_path), "--region", "brno", *words])
    assert ended.value.code == 2
    assert "one of them" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--server", "127.0.0.1:4222"], "neither nats://HOST:PORT nor tls://HOST:PORT"),
        (["--server", "nats://a:1", "--authority", "a.pem"], "--authority only with"),
    ],
)
def test_a_server_is_spoken_to_as_its_address_says(tmp_path, words, told, capsys):
    with pytest.raises(SystemExit) as ended:
        main([str(tmp_path), "--region", "brno", "--stream", "OLS_r", *words])
    assert ended.value.code == 2
    assert told in capsys.readouterr().err
