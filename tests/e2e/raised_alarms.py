"""Alarms of the table of conditions in a status, as programs write them."""

import sys
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "conditions"))
import table  # noqa: E402

SAYS = {
    name: english
    for row in table.alarms(table.table())
    for name, (english, _) in row["says"].items()
}
Raised = tuple[str, dict[str, str]]  # id, parameters


def put_alarms(message: Any, alarms: list[Raised]) -> None:
    """Into a station_status_t or fusion_status_t."""
    message.alarm = [table.PARAMETER.sub(lambda p, of=of: of[p[1]], SAYS[i]) for i, of in alarms]
    message.alarm_id = [identifier for identifier, _ in alarms]
    message.alarms = message.alarm_ids = len(alarms)
    all_of = [(k, *one) for k, (_, of) in enumerate(alarms) for one in of.items()]
    message.alarm_parameters = len(all_of)
    message.alarm_parameter_of = [k for k, _, _ in all_of]
    message.alarm_parameter_name = [name for _, name, _ in all_of]
    message.alarm_parameter_value = [value for _, _, value in all_of]
