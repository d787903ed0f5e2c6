# SPDX-License-Identifier: Apache-2.0
from datetime import UTC, datetime
from xml.etree import ElementTree

import pytest

from srnn_bringup.dds_security.certificates import validity_from
from srnn_bringup.dds_security.enclaves import MEMBERS, access, enclave
from srnn_bringup.dds_security.permissions import governance_xml, permissions_xml

DOMAIN = 42
VALIDITY = validity_from(datetime(2030, 1, 2, 3, 4, 5, 678, UTC))

# Order of the elements, from the schemas of the DDS Security standard; * repeats.
PERMISSIONS = {
    'dds': ['permissions'],
    'permissions': ['grant'],
    'grant': ['subject_name', 'validity', 'allow_rule', 'default'],
    'validity': ['not_before', 'not_after'],
    'allow_rule': ['domains', 'publish', 'subscribe'],
    'domains': ['id'],
    'publish': ['topics'],
    'subscribe': ['topics'],
    'topics': ['topic*'],
}
GOVERNANCE = {
    'dds': ['domain_access_rules'],
    'domain_access_rules': ['domain_rule'],
    'domain_rule': [
        'domains', 'allow_unauthenticated_participants', 'enable_join_access_control',
        'discovery_protection_kind', 'liveliness_protection_kind', 'rtps_protection_kind',
        'topic_access_rules',
    ],
    'domains': ['id'],
    'topic_access_rules': ['topic_rule'],
    'topic_rule': [
        'topic_expression', 'enable_discovery_protection', 'enable_liveliness_protection',
        'enable_read_access_control', 'enable_write_access_control',
        'metadata_protection_kind', 'data_protection_kind',
    ],
}  # fmt: skip

members = pytest.mark.parametrize('member', MEMBERS)


def permissions(member: str) -> ElementTree.Element:
    text = permissions_xml(enclave(member), access(member), DOMAIN, VALIDITY)
    return ElementTree.fromstring(text.encode())


def check(element: ElementTree.Element, order: dict[str, list[str]]) -> None:
    expected = order.get(element.tag, [])
    tags = [child.tag for child in element]
    if expected and expected[0].endswith('*'):
        assert tags
        expected = [expected[0].removesuffix('*')] * len(tags)
    assert tags == expected
    assert bool((element.text or '').strip()) == (not tags)
    for child in element:
        check(child, order)


@members
def test_permissions_have_the_form_of_the_standard(member):
    root = permissions(member)
    check(root, PERMISSIONS)
    assert root.find('permissions/grant').get('name') == enclave(member)


@members
def test_permissions_are_the_rights_for_one_subject_and_domain(member):
    grant = permissions(member).find('permissions/grant')
    assert grant.findtext('subject_name') == f'CN={enclave(member)}'
    assert [item.text for item in grant.iter('id')] == [str(DOMAIN)]
    said = {
        action: tuple(item.text for item in grant.findall(f'allow_rule/{action}/topics/topic'))
        for action in ('publish', 'subscribe')
    }
    rights = access(member)
    assert said == {'publish': rights.dds_publishes, 'subscribe': rights.dds_hears}


@members
def test_what_is_not_allowed_is_denied(member):
    assert permissions(member).findtext('permissions/grant/default') == 'DENY'


def test_permissions_begin_a_day_ago_and_end_in_ten_years():
    validity = permissions('planner').find('permissions/grant/validity')
    assert validity.findtext('not_before') == '2030-01-01T03:04:05'
    assert validity.findtext('not_after') == '2039-12-31T03:04:05'


def test_governance_has_the_form_of_the_standard():
    check(ElementTree.fromstring(governance_xml(DOMAIN).encode()), GOVERNANCE)


def test_governance_lets_nobody_in_without_a_certificate_and_checks_every_topic():
    rule = ElementTree.fromstring(governance_xml(DOMAIN).encode()).find('.//domain_rule')
    assert [item.text for item in rule.iter('id')] == [str(DOMAIN)]
    assert rule.findtext('allow_unauthenticated_participants') == 'false'
    assert rule.findtext('enable_join_access_control') == 'true'
    topics = rule.find('topic_access_rules/topic_rule')
    assert topics.findtext('topic_expression') == '*'
    assert topics.findtext('enable_read_access_control') == 'true'
    assert topics.findtext('enable_write_access_control') == 'true'
    assert topics.findtext('data_protection_kind') == 'ENCRYPT'
