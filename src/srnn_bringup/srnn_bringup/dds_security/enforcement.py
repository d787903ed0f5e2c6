# SPDX-License-Identifier: Apache-2.0
"""Whether a graph with a keystore would really be protected, before anything of it starts."""

from collections.abc import Mapping
from pathlib import Path
import subprocess
import sys
import tempfile

from srnn_bringup.dds_security.enclaves import COMMAND
from srnn_bringup.dds_security.keystore import (
    SIGNED,
    check_keystore,
    create_keystore,
    enclave_folder,
)
from srnn_bringup.environment import domain_id, graph_environment
from srnn_bringup.errors import ChoiceError, NotReadyError, SecurityError

ENCLAVE_OVERRIDE = 'ROS_SECURITY_ENCLAVE_OVERRIDE'

TRY_S = 60.0
"""Longest wait for the middleware to show what it does with a keystore [s]."""


def require_security(keystore: Path, environ: Mapping[str, str]) -> None:
    """Check that a graph with this keystore will be protected.

    Args:
        keystore: directory.
        environ: environment of the graph.

    Raises:
        ChoiceError: the environment would give all nodes one identity.
        KeystoreError: the keystore is not complete, or for another domain.
        SecurityError: the middleware has no DDS security.
        NotReadyError: it does not show within a minute whether it has.

    """
    override = environ.get(ENCLAVE_OVERRIDE)
    if override:
        raise ChoiceError(
            f'{ENCLAVE_OVERRIDE} = {override!r}: every node would have this identity, '
            'and none its own; unset it'
        )
    check_keystore(keystore, domain_id(environ))
    lack = lack_of_security(environ)
    if lack:
        raise SecurityError(
            f'this middleware has no DDS security ({lack}); '
            'use the key instead: srnn key create FILE, then srnn up --key FILE'
        )


def lack_of_security(environ: Mapping[str, str]) -> str:
    """Return why the middleware does not protect the graph, empty if it does.

    It is tried out. A process of its own enters the domain with a keystore made for this,
    and must get in; then with permissions that a stranger has signed, and must be turned
    away. Looking for the plug-ins in the libraries instead would need to know every
    middleware and the places where it may lie, would not tell whether its ROS layer was
    built to use them, and would trust one that takes the keystore and ignores it.

    Args:
        environ: environment of the graph.

    Raises:
        NotReadyError: the trial takes too long.

    """
    with tempfile.TemporaryDirectory(prefix='srnn_') as folder:
        valid, forged = Path(folder, 'valid'), Path(folder, 'forged')
        for keystore in (valid, forged):
            create_keystore(keystore, domain_id(environ))
        theirs = enclave_folder(valid, COMMAND) / SIGNED
        (enclave_folder(forged, COMMAND) / SIGNED).write_bytes(theirs.read_bytes())
        environment = graph_environment(environ)
        environment.pop(ENCLAVE_OVERRIDE, None)
        probe = 'srnn_bringup.dds_security.probe'
        command = [sys.executable, '-m', probe, str(valid), str(forged)]
        try:
            done = subprocess.run(
                command,
                env=environment,
                capture_output=True,
                text=True,
                timeout=TRY_S,
            )
        except subprocess.TimeoutExpired:
            raise NotReadyError(
                f'the middleware does not show within {TRY_S:g} s whether it has DDS security'
            ) from None
    if done.returncode == 0:
        return ''
    lines = (done.stdout.strip() or done.stderr.strip()).splitlines()
    return lines[-1] if lines else f'exit code {done.returncode}'
