# SPDX-License-Identifier: Apache-2.0
from pathlib import Path

import pytest

from srnn_bringup.config_lookup import config_directory
from srnn_bringup.environment import (
    DISCOVERY_RANGE,
    DOMAIN_ID,
    FAST_DDS,
    MIDDLEWARE,
    PROFILES,
    check_environment,
    graph_environment,
)
from srnn_bringup.errors import ChoiceError

LOOPBACK = {DISCOVERY_RANGE: 'SYSTEM_DEFAULT', PROFILES: str(config_directory() / 'fastdds.xml')}


@pytest.mark.parametrize(
    'environ', [{}, {DISCOVERY_RANGE: ''}, {DISCOVERY_RANGE: 'LOCALHOST'}, {MIDDLEWARE: FAST_DDS}]
)
def test_the_graph_talks_over_the_loopback_interface(environ):
    assert graph_environment(environ).items() >= LOOPBACK.items()
    assert Path(LOOPBACK[PROFILES]).is_file()


@pytest.mark.parametrize(
    'environ',
    [
        {DISCOVERY_RANGE: 'SUBNET'},
        {DISCOVERY_RANGE: 'LOCALHOST', PROFILES: 'mine.xml'},
        {DISCOVERY_RANGE: 'SYSTEM_DEFAULT', PROFILES: 'mine.xml'},
        {DISCOVERY_RANGE: 'LOCALHOST', 'FASTDDS_BUILTIN_TRANSPORTS': 'SHM'},
        {DISCOVERY_RANGE: 'LOCALHOST', MIDDLEWARE: 'rmw_other'},
    ],
)
def test_the_user_may_decide_otherwise(environ):
    chosen = graph_environment(environ)
    assert chosen.items() >= environ.items()
    assert chosen.get(PROFILES) == environ.get(PROFILES)


def test_whatever_else_the_user_decides_the_graph_stays_on_this_host():
    assert graph_environment({MIDDLEWARE: 'rmw_other'})[DISCOVERY_RANGE] == 'LOCALHOST'
    assert graph_environment({PROFILES: 'mine.xml'})[DISCOVERY_RANGE] == 'LOCALHOST'


def test_the_environment_of_the_graph_is_that_of_its_own_processes():
    once = graph_environment({'PATH': '/bin'})
    assert graph_environment(once) == once


def test_the_domain_is_that_of_the_user():
    assert 'ROS_DOMAIN_ID' not in graph_environment({})
    assert graph_environment({'ROS_DOMAIN_ID': '7'})['ROS_DOMAIN_ID'] == '7'


def test_small_matrices_use_one_thread():
    assert graph_environment({})['OPENBLAS_NUM_THREADS'] == '1'
    assert graph_environment({'OPENBLAS_NUM_THREADS': '2'})['OPENBLAS_NUM_THREADS'] == '2'


@pytest.mark.parametrize(
    ('environ', 'words'),
    [
        ({DOMAIN_ID: 'abc'}, "'abc': must be 0 to 232"),
        ({DOMAIN_ID: '-1'}, "'-1': must be 0 to 232"),
        ({DOMAIN_ID: '233'}, "'233': must be 0 to 232"),
        ({DISCOVERY_RANGE: 'localhost'}, 'must be one of LOCALHOST, SUBNET'),
    ],
)
def test_values_that_the_middleware_cannot_use_are_refused(environ, words):
    with pytest.raises(ChoiceError) as caught:
        check_environment(environ)
    assert words in str(caught.value)


@pytest.mark.parametrize('environ', [{}, {DOMAIN_ID: ''}, {DOMAIN_ID: '232'}])
def test_what_the_middleware_can_use_is_not_refused(environ):
    check_environment(environ)


def test_the_rest_is_handed_on():
    assert graph_environment({'PATH': '/bin'})['PATH'] == '/bin'
