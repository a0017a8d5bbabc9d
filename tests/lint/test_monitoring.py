"""Alert rules fire when they must and not before; rules and dashboard name metrics that exist."""

import json
import re
import shutil
from pathlib import Path

import pytest
from conftest import finished

ROOT = Path(__file__).resolve().parents[2]
EXPORTER = ROOT / "tools/exporter"
ALERTS = EXPORTER / "prometheus/alerts.yml"
METRIC = re.compile(r"\bols_[a-z_]+\b")
SOURCES = "".join(path.read_text() for path in sorted(EXPORTER.glob("*_metrics.cpp")))
EXISTING = set(METRIC.findall(SOURCES)) - {"ols_msg"}
needs_promtool = pytest.mark.skipif(
    shutil.which("promtool") is None, reason="promtool (package prometheus) is not installed"
)


def expressions():
    rules = re.findall(r"^ +expr: (.*)$", ALERTS.read_text(), flags=re.M)
    board = json.loads((EXPORTER / "grafana/site.json").read_text())
    return rules + [t["expr"] for panel in board["panels"] for t in panel["targets"]]


def promtool(folder, *words):
    return finished("promtool", *words, cwd=folder)


@needs_promtool
def test_the_rules_fire_when_they_must(tmp_path):
    shutil.copy(ALERTS, tmp_path)
    shutil.copy(ROOT / "tests/lint/alerts_test.yml", tmp_path)
    checked = promtool(tmp_path, "check", "rules", "alerts.yml")
    assert checked.returncode == 0, checked.stdout + checked.stderr
    done = promtool(tmp_path, "test", "rules", "alerts_test.yml")
    assert done.returncode == 0, done.stdout + done.stderr


def test_every_rule_is_tested():
    named = re.findall(r"alert: (\w+)", ALERTS.read_text())
    tests = (ROOT / "tests/lint/alerts_test.yml").read_text()
    assert named
    assert [
        name for name in named if not re.search(rf"alertname: {name}\n *exp_alerts", tests)
    ] == []


def test_rules_and_dashboard_name_metrics_that_exist():
    assert len(EXISTING) > 15
    for expression in expressions():
        used = set(METRIC.findall(expression))
        assert used or "up{" in expression, expression
        assert used <= EXISTING, expression
