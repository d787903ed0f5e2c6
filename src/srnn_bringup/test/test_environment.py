# SPDX-License-Identifier: Apache-2.0
from pathlib import Path

import pytest

from srnn_bringup.environment import (
    DISCOVERY_RANGE,
    DOMAIN_ID,
    PROFILES,
    TRANSPORTS,
    check_environment,
    graph_environment,
)
from srnn_bringup.errors import ChoiceError


def test_the_graph_stays_on_this_host_unless_the_user_decides_otherwise():
    assert graph_environment({})[DISCOVERY_RANGE] == 'LOCALHOST'
    assert graph_environment({DISCOVERY_RANGE: 'SUBNET'})[DISCOVERY_RANGE] == 'SUBNET'


def test_new_participants_announce_themselves_often_unless_the_user_decides_otherwise():
    assert Path(graph_environment({})[PROFILES]).is_file()
    assert graph_environment({PROFILES: 'mine.xml'})[PROFILES] == 'mine.xml'


def test_the_graph_talks_over_udp_unless_the_user_decides_otherwise():
    assert graph_environment({})[TRANSPORTS] == 'UDPv4'
    assert graph_environment({TRANSPORTS: 'SHM'})[TRANSPORTS] == 'SHM'


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
