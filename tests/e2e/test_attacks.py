"""Every attack of tools/bench attacks on a small live site, short and slow: none moves anything,
none is lost track of. How fast the site stays under the greatest rate is for the bench to say."""

import json

import pytest
from conftest import BIN, SCENARIO
from ols_attacks.__main__ import main

REASONS = {
    "forged commands": {"stranger"},
    "replayed commands": {"replayed"},
    "mis-addressed commands": {"stranger"},
    "stale commands": {"stale", "rate", "replayed"},
    "commands by another role": {"channel"},
    "commands to another boot": {"other_boot"},
    "unsigned designations": {"unsigned"},
    "bearings in real names": {"unsigned"},
    "bearings of 100 invented stations": {"unsigned"},
    "1000 invented names": {"unsigned"},
    "hostile values": {"unsigned"},
    "forged statuses": {"unsigned", "channel"},
    "a recorded log": {"replayed", "stale"},
    "a stolen key gone mad": {"rate", "replayed"},
    "flood of 50 000 unsigned/s": {"unsigned"},
}


@pytest.mark.usefixtures("network")
def test_no_attack_moves_a_live_site_and_each_is_accounted_for(tmp_path):
    words = ["--seconds", "1", "--most", "400", "--names", "1000"]
    words += ["--scenario", str(SCENARIO.parent / "small.toml")]
    words += ["--bin", str(BIN), "--output", str(tmp_path / "attacks")]
    assert main(words) == 0
    rows = json.loads((tmp_path / "attacks/attacks.json").read_text())["rows"]
    attacks = {row["attack"]: row for row in rows if "sent" in row}
    assert set(attacks) == set(REASONS)
    for name, row in attacks.items():
        assert row["sent"] > 100, name
        assert row.get("lost_track_of", 0) <= 0, name
        assert row["obeyed"] == row["false_targets"] == 0, name
        assert set(row["refused"]) <= REASONS[name], name
