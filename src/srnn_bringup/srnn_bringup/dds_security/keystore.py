# SPDX-License-Identifier: Apache-2.0
"""A keystore as `ros2 security` lays it out, with one enclave for every member of the graph.

::

    public/    identity_ca.cert.pem, permissions_ca.cert.pem
    private/   identity_ca.key.pem, permissions_ca.key.pem
    enclaves/  governance.xml, governance.p7s
    enclaves/srnn/<member>/  key.pem, cert.pem, permissions.xml, permissions.p7s, and links
                             to the certificates of both authorities and to governance.p7s

`ros2 security` itself takes one authority for both purposes. Here there are two: Cyclone DDS
believes permissions signed by any certificate of the authority, that is by any enclave.
"""

from datetime import UTC, datetime
import os
from pathlib import Path
import re
import shutil
import tempfile

from srnn_bringup.dds_security.certificates import found_authority, issue, sign, validity_from
from srnn_bringup.dds_security.enclaves import COMMAND, MEMBERS, access, enclave
from srnn_bringup.dds_security.permissions import governance_xml, permissions_xml
from srnn_bringup.errors import KeystoreError

IDENTITY = 'identity_ca'
"""The authority that says who is who."""

PERMISSIONS = 'permissions_ca'
"""The authority that says who may do what."""

SIGNED = 'permissions.p7s'
FILES = (
    f'{IDENTITY}.cert.pem', f'{PERMISSIONS}.cert.pem', 'governance.p7s',
    'key.pem', 'cert.pem', 'permissions.xml', SIGNED,
)  # fmt: skip
"""What every enclave has."""

_AUTHORITIES = (IDENTITY, PERMISSIONS)
_DOMAIN = re.compile(rb'<id>\s*(\d+)\s*</id>')


def create_keystore(directory: Path, domain: int) -> None:
    """Make a keystore, all of it or nothing.

    Args:
        directory: where to; it must not be there yet, or be empty.
        domain: ROS_DOMAIN_ID in which its enclaves may take part.

    Raises:
        KeystoreError: something is there already, or there is no place for it.
        OSError: it cannot be written.

    """
    directory = directory.resolve()
    if directory.exists() and not (directory.is_dir() and not any(directory.iterdir())):
        raise KeystoreError(f'{directory} is there already; choose a new directory')
    if not directory.parent.is_dir():
        raise KeystoreError(f'there is no directory {directory.parent}')
    # Not readable for others, as everything that is made of it.
    draft = Path(tempfile.mkdtemp(prefix=f'.{directory.name}.', dir=directory.parent))
    try:
        _fill(draft, domain)
        draft.rename(directory)
    except BaseException:
        shutil.rmtree(draft)
        raise


def check_keystore(directory: Path, domain: int) -> None:
    """Check that every enclave is complete and may take part in a domain.

    The private keys of the authority may be elsewhere: nodes do not need them.

    Args:
        directory: the keystore.
        domain: ROS_DOMAIN_ID.

    Raises:
        KeystoreError: a file is missing, or the permissions are for another domain.

    """
    for member in MEMBERS:
        folder = enclave_folder(directory, member)
        for name in FILES:
            if not (folder / name).is_file():
                raise KeystoreError(
                    f'keystore {directory} is not complete: {folder / name} is missing; '
                    'srnn keystore create DIR makes a new one'
                )
        # The signature covers a copy in clear, and that is what the middleware reads.
        allowed = {int(found) for found in _DOMAIN.findall((folder / SIGNED).read_bytes())}
        if allowed and domain not in allowed:
            domains = ', '.join(map(str, sorted(allowed)))
            raise KeystoreError(
                f'ROS_DOMAIN_ID = {domain}: {folder / SIGNED} is for {domains}; '
                'use that domain, or make a keystore for this one'
            )


def enclave_folder(directory: Path, member: str) -> Path:
    """Return where the files of a member are."""
    return directory / 'enclaves' / enclave(member).removeprefix('/')


def _fill(root: Path, domain: int) -> None:
    for folder in ('public', 'private', 'enclaves', enclave_folder(Path(), COMMAND).parent):
        (root / folder).mkdir(mode=0o700)
    validity = validity_from(datetime.now(UTC))
    authorities = {name: found_authority(f'srnn_{name}', validity) for name in _AUTHORITIES}
    for name, authority in authorities.items():
        _write(root / 'public' / f'{name}.cert.pem', authority.certificate_pem())
        _write(root / 'private' / f'{name}.key.pem', authority.key_pem())
    governance = governance_xml(domain)
    _write(root / 'enclaves' / 'governance.xml', governance.encode())
    _write(root / 'enclaves' / 'governance.p7s', sign(authorities[PERMISSIONS], governance))
    for member in MEMBERS:
        folder = enclave_folder(root, member)
        folder.mkdir(mode=0o700)
        identity = issue(authorities[IDENTITY], enclave(member), validity)
        permissions = permissions_xml(enclave(member), access(member), domain, validity)
        _write(folder / 'key.pem', identity.key_pem())
        _write(folder / 'cert.pem', identity.certificate_pem())
        _write(folder / 'permissions.xml', permissions.encode())
        _write(folder / SIGNED, sign(authorities[PERMISSIONS], permissions))
        for name in _AUTHORITIES:
            _link(folder / f'{name}.cert.pem', root / 'public' / f'{name}.cert.pem')
        _link(folder / 'governance.p7s', root / 'enclaves' / 'governance.p7s')


def _write(path: Path, content: bytes) -> None:
    """Write a new file that only its owner may read."""
    with open(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), 'wb') as file:
        file.write(content)


def _link(path: Path, target: Path) -> None:
    # Relative, so that the keystore can be moved.
    path.symlink_to(os.path.relpath(target, path.parent))
