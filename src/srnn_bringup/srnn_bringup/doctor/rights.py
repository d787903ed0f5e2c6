# SPDX-License-Identifier: Apache-2.0
"""What rights the process has."""

from collections.abc import Iterator

from srnn_bringup.doctor import probes
from srnn_bringup.doctor.finding import Finding, Verdict

LIMITS = '/etc/security/limits.d/srnn.conf'


def rights() -> Iterator[Finding]:
    """Yield the real-time rights of the process."""
    subject, refusal = 'real-time priority', probes.real_time_refusal()
    if refusal:
        words = f'SCHED_FIFO, {refusal}: the arm is controlled with more jitter'
        advice = f"'USER - rtprio 98' in {LIMITS} and log in anew; containers: --cap-add SYS_NICE"
        yield Finding(subject, Verdict.WARN, words, advice)
    else:
        yield Finding(subject, Verdict.OK, 'SCHED_FIFO is allowed')
    subject, lockable = 'locked memory', probes.lockable_bytes()
    if lockable is None:
        yield Finding(subject, Verdict.OK, 'unlimited')
    else:
        words = f'at most {lockable // 1024} KiB; pages may be fetched while the arm moves'
        advice = f"'USER - memlock unlimited' in {LIMITS} and log in anew"
        yield Finding(subject, Verdict.WARN, words, advice)
