# SPDX-License-Identifier: Apache-2.0
"""The driver says where the conversation is; only in command mode all is well."""

import pytest

from lwr_fri_driver.core.driver_health import SLEEPING_S, driver_health
from lwr_fri_driver.core.phase import Phase
from lwr_fri_driver.core.reports import Status
from srnn_msgs_py.health import HealthLevel


def status(phase):
    return Status(phase, 'words', {'lost': 3})


@pytest.mark.parametrize('phase', Phase)
def test_only_an_active_driver_minds_where_it_is(phase):
    levels = {Phase.COMMANDING: HealthLevel.OK, Phase.FAULT: HealthLevel.ERROR}
    health = driver_health(status(phase), SLEEPING_S, active=True)
    assert health.level is levels.get(phase, HealthLevel.WARN)
    assert (health.message, health.values) == ('words', {'phase': phase.name, 'lost': 3})
    assert driver_health(status(phase), 0.0, active=False).level is HealthLevel.OK


@pytest.mark.parametrize('active', [False, True])
def test_a_process_that_sleeps_is_an_error_whatever_it_has_said(active):
    health = driver_health(status(Phase.COMMANDING), SLEEPING_S + 0.1, active)
    assert health.level is HealthLevel.ERROR
    assert health.message == 'the process that answers the controller sleeps'
