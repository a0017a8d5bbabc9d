"""Two regions with a hub each, the second a leaf of the first as the example has it: their fusions
see the same target, and one of them publishes it."""

import re

import pytest
from bridge_site import Bridge, Server, active, bus_url, key, needs_server
from test_bridge_owners import EAST, OWNERS, WEST, Sky, never_two

pytestmark = needs_server


class TwoHubs(Sky):
    """The east is another region, q, at a hub of its own."""

    def other_fusion(self):
        folder = self.net.folder / "q"
        folder.mkdir()
        seed = self.net.seeds["neighbour"].read_text().strip()
        (folder / "leaf-key.conf").write_text(f"nkey: {seed}\n")
        public = key(folder / "bridge.seed")
        self.hub = Server(folder, "nats-hub.conf", lambda text: self.second_hub(text, public))
        return Bridge(
            *(folder, "east", bus_url(7669), folder / "bridge.seed", public),
            port=4224,
            head='role = "region"\nregion = "q"\ntargets = true\n',
            tail=OWNERS.format("east", EAST[1]),
        )

    @staticmethod
    def second_hub(text, public):
        text = re.sub(r"^  tls \{.*?\n  \}\n", "", text, flags=re.S | re.M)
        text = active(text, "hub. In its own file", "}]")
        text = re.sub(r"^ *tls \{ ca_file.*\n", "", text, flags=re.M)
        text = text.replace("tls://hub.example:7422", "nats-leaf://127.0.0.1:7422")
        text = text.replace("0.0.0.0:7422", "127.0.0.1:7424").replace("4222", "4224")
        text = text.replace("server_name: hub", "server_name: hub-q")
        text = text.replace("domain: hub", "domain: hub-q")
        text = text.replace('# "$JS.hub.API.>"', '"$JS.hub.API.>"', 1)
        # Its users: its bridge alone.
        text = text.replace("UBRIDGEOFTHEREGION", public).replace(
            '"ols.v1.r.target"', '"ols.v1.q.target"'
        )
        end = text.index("# ols-archive on this host")
        return text[: text.rindex("{", 0, end)] + "  ]\n}\n"

    def close(self):
        super().close()
        self.hub.stop()


@pytest.fixture
def sky(network, tmp_path):
    sky = TwoHubs(tmp_path)
    yield sky
    sky.close()


def test_a_target_changes_the_region(sky):
    sky.begin()
    sky.fly(3000.0)
    sky.until(lambda heard: heard[-1][1] == EAST[0], "the other region has it")
    sky.fly(-3000.0)
    sky.until(lambda heard: heard[-1][1] == WEST[0], "and back")
    heard = list(sky.heard())
    never_two(heard)
    assert len({name for _, _, name, *_ in heard}) == 1, "the same target all the time"
    regions = {subject for _, subject, *_ in sky.watcher.heard if subject.endswith(".target")}
    assert regions == {"ols.v1.r.target", "ols.v1.q.target"}
