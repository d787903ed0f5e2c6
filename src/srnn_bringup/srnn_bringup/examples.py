# SPDX-License-Identifier: Apache-2.0
"""Command lines to begin with, shown by the help of every command."""

from collections.abc import Mapping

EXAMPLES: Mapping[str, Mapping[str, str]] = {
    '': {
        'srnn doctor': 'is this machine ready?',
        'srnn demo': 'watch the arm learn, for about three minutes',
        'srnn demo --help': 'what else it can do',
    },
    'demo': {
        'srnn demo --scene corner --signal global': 'another scene, another learning signal',
        'srnn demo --arm-description ur5e --segments 20': 'another arm, a short run',
        'srnn demo --record run --json - --quiet': 'only the figures, and a recording',
    },
    'up': {
        'srnn up --view': 'with a web page that shows it',
        'srnn up --weights learned.npz --record run': 'go on from what was learned',
        'srnn up --arm fri --emulator': 'the driver of the real arm, with an emulated controller',
    },
    'pause': {
        'srnn pause': 'the graph of this host',
        'srnn pause --peer 192.0.2.7': 'a graph with a part on another host',
    },
    'resume': {
        'srnn resume': 'the graph of this host',
        'srnn resume --peer 192.0.2.7': 'a graph with a part on another host',
    },
    'record': {
        'srnn record run': 'until Ctrl-C',
        'srnn record run --secure keystore': 'a graph with DDS security',
    },
    'replay': {
        'srnn replay run': 'were all decisions the same?',
        'srnn replay run --set learning.replays=40': 'what would have been learned otherwise?',
        'srnn replay run --publish --rate 2': 'for RViz or Foxglove, twice as fast',
    },
    'report': {
        'srnn report run': 'a recording, as run.html',
        'srnn report results --out results.html': 'what srnn experiment has written',
    },
    'belief': {
        'srnn belief list run': 'every version in a recording',
        'srnn belief show run learned.png': 'a picture of the newest',
    },
    'belief list': {
        'srnn belief list run': 'every version in a recording',
        'srnn belief list run --json -': 'the same for machines',
    },
    'belief show': {
        'srnn belief show run learned.png': 'the newest version',
        'srnn belief show run@2 learned.png': 'version 2',
        'srnn belief show learned.npz learned.png': 'a weight file',
    },
    'belief diff': {
        'srnn belief diff run@1 run@3': 'what two updates have changed',
        'srnn belief diff run other --picture diff.png': 'two runs',
    },
    'belief revert': {
        'srnn belief revert run@2 without.npz': 'undo what made version 2',
        'srnn up --weights without.npz': 'go on without it',
    },
    'belief merge': {
        'srnn belief merge run other both.npz': 'two runs',
        'srnn up --weights both.npz': 'go on with both',
    },
    'doctor': {
        'srnn doctor': 'look at everything',
        'srnn doctor --json -': 'the same for machines',
        'srnn doctor --quiet': 'only the exit code',
    },
    'key': {
        'srnn key create graph.key': 'make a key',
        'srnn up --key graph.key': 'use it',
    },
    'key create': {
        'srnn key create graph.key': 'make a key',
        'srnn up --key graph.key': 'use it',
    },
    'keystore': {
        'srnn keystore create keystore': 'make keys and permissions',
        'srnn up --secure keystore': 'use them',
    },
    'keystore create': {
        'srnn keystore create keystore': 'make keys and permissions',
        'srnn up --secure keystore': 'use them',
    },
    'experiment': {
        'srnn experiment run --trials 10 --json trials.json': 'one setting',
        'srnn experiment table1 --out table1': "the paper's table",
    },
    'experiment run': {
        'srnn experiment run --trials 10 --json trials.json': 'ten trials, resumed after a kill',
        'srnn experiment run --world point --agent grid --segments 50': 'A*, in a simpler world',
        'srnn experiment run --segments 50 --json - --quiet': 'only the figures',
    },
    'experiment random': {
        'srnn experiment random --out random': 'a hundred scenes',
        'srnn experiment random --scenes 5 --world point --out random': 'a few, fast',
    },
    'experiment transfer': {
        'srnn experiment transfer --out transfer': 'as in the report',
        'srnn experiment transfer --trials 2 --segments 50 --out transfer': 'a short one',
    },
    'experiment table1': {
        'srnn experiment table1 --out table1': 'as long as in the paper',
        'srnn experiment table1 --trials 2 --world point --out table1': 'a short one',
    },
    'experiment figures': {
        'srnn experiment figures --out figures': 'as long as in the paper',
        'srnn experiment figures --trials 2 --long 300 --world point --out figures': 'short ones',
    },
    'bench': {
        'srnn bench --repeats 5': 'all rows, a few rounds',
        'srnn bench --only planner,a-star --out bench.md': 'two rows',
        'srnn bench --only planner --repeats 2 --json -': 'for machines',
    },
    'completion': {
        'srnn completion bash > ~/.local/share/bash-completion/completions/srnn': 'for bash',
        'srnn completion zsh > ~/.zfunc/_srnn': 'for zsh, with ~/.zfunc in its fpath',
    },
}
"""Examples and what they are for, by command; '' for `srnn` itself."""


def epilog(command: str, *remarks: str) -> str:
    """Return what stands below the options of a command: examples, then remarks."""
    lines = [f'  {line}\n      {purpose}' for line, purpose in EXAMPLES.get(command, {}).items()]
    return '\n\n'.join(['\n'.join(['examples:', *lines]), *map(str.rstrip, remarks)])
