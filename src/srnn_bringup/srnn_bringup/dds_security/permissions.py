# SPDX-License-Identifier: Apache-2.0
"""The two documents of DDS access control: permissions of an enclave, and governance."""

from collections.abc import Sequence
from datetime import datetime
from xml.etree import ElementTree
from xml.etree.ElementTree import Element, SubElement

from srnn_bringup.dds_security.certificates import Validity
from srnn_bringup.dds_security.enclaves import Access

_INSTANCE = 'http://www.w3.org/2001/XMLSchema-instance'
_SCHEMAS = 'http://www.omg.org/spec/DDS-SECURITY/20170901'

_PARTICIPANTS = {
    'allow_unauthenticated_participants': 'false',
    'enable_join_access_control': 'true',
    'discovery_protection_kind': 'ENCRYPT',
    'liveliness_protection_kind': 'ENCRYPT',
    'rtps_protection_kind': 'SIGN',
}
"""Nobody takes part without a certificate; the values are those of `ros2 security`."""

_EVERY_TOPIC = {
    'topic_expression': '*',
    'enable_discovery_protection': 'true',
    'enable_liveliness_protection': 'true',
    'enable_read_access_control': 'true',
    'enable_write_access_control': 'true',
    'metadata_protection_kind': 'ENCRYPT',
    'data_protection_kind': 'ENCRYPT',
}
"""Every topic is encrypted, and read and written by those with the permission only."""


def permissions_xml(enclave: str, rights: Access, domain: int, validity: Validity) -> str:
    """Return the permissions document of one enclave; what it does not allow is denied.

    Args:
        enclave: name of the enclave, which is the common name of its certificate.
        rights: what it may do.
        domain: ROS_DOMAIN_ID in which it may do that.
        validity: when it may.

    """
    root = _document('permissions')
    grant = SubElement(SubElement(root, 'permissions'), 'grant', name=enclave)
    _text(grant, 'subject_name', f'CN={enclave}')
    span = SubElement(grant, 'validity')
    _text(span, 'not_before', _moment(validity.begin))
    _text(span, 'not_after', _moment(validity.end))
    rule = SubElement(grant, 'allow_rule')
    _add_domain(rule, domain)
    _add_topics(rule, 'publish', rights.dds_publishes)
    _add_topics(rule, 'subscribe', rights.dds_hears)
    _text(grant, 'default', 'DENY')
    return _to_text(root)


def governance_xml(domain: int) -> str:
    """Return the governance document: what is protected in a domain, and how.

    Args:
        domain: ROS_DOMAIN_ID that it is for.

    """
    root = _document('governance')
    rule = SubElement(SubElement(root, 'domain_access_rules'), 'domain_rule')
    _add_domain(rule, domain)
    for tag, value in _PARTICIPANTS.items():
        _text(rule, tag, value)
    topic_rule = SubElement(SubElement(rule, 'topic_access_rules'), 'topic_rule')
    for tag, value in _EVERY_TOPIC.items():
        _text(topic_rule, tag, value)
    return _to_text(root)


def _document(kind: str) -> Element:
    schema = f'{_SCHEMAS}/omg_shared_ca_{kind}.xsd'
    return Element('dds', {'xmlns:xsi': _INSTANCE, 'xsi:noNamespaceSchemaLocation': schema})


def _add_domain(rule: Element, domain: int) -> None:
    _text(SubElement(rule, 'domains'), 'id', str(domain))


def _add_topics(rule: Element, action: str, names: Sequence[str]) -> None:
    topics = SubElement(SubElement(rule, action), 'topics')
    for name in names:
        _text(topics, 'topic', name)


def _text(parent: Element, tag: str, text: str) -> None:
    SubElement(parent, tag).text = text


def _moment(time: datetime) -> str:
    return time.strftime('%Y-%m-%dT%H:%M:%S')


def _to_text(root: Element) -> str:
    ElementTree.indent(root)
    text = ElementTree.tostring(root, encoding='unicode')
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{text}\n'
