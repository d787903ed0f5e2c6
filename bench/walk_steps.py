# SPDX-License-Identifier: Apache-2.0
"""The three walks: what a stranger types in, and what it has to do."""

from pathlib import Path
import sys

from walk import ROS_SETUP, SOURCE, Step, Walk

sys.path.insert(0, str(Path(__file__).parents[1] / 'test'))
from documented import ROOT, blocks

FIRST_RUN_S = 300.0
"""For what compiles the kernels or downloads, on a slow machine [s]."""

LEARNED = r'^\d+ segments in .* touch(es)? \(0 in the last third\), [1-9]\d* updates?$'
"""What `srnn demo` says of a run in which an obstacle was learned."""


def written(name: str) -> str:
    """Return the command that writes a file of the tutorial."""
    (text,) = (
        block.text for block in blocks(ROOT / 'docs' / 'tutorial.md') if block.name == name
    )
    return f"cat > {name} <<'END'\n{text}END"


def cloned(folder: str) -> Step:
    """Return the step that gets the repository."""
    return Step('Get it.', f'git clone {SOURCE} {folder}', 'Cloning into')


LAPTOP = Walk(
    'laptop', 'a laptop with nothing but Python', 'Python, git and make', (
        cloned('srnn'),
        Step('Go there.', 'cd srnn', kept=True),
        Step('The first command of the README. It sets up all that is needed first.',
             'make demo', LEARNED, limit_s=500.0),
        Step('The tutorial: `srnn` without a path from here on.', 'source .venv/bin/activate',
             kept=True),
        Step('What else is there?', 'srnn --help', 'demo'),
        Step('Is all well with this machine?', 'srnn doctor', r'^\d+ findings: .* 0 FAIL$'),
        Step('An option, mistyped.', 'srnn demo --segmnts 60',
             r"unknown argument '--segmnts' \(did you mean '--segments'\?\)", code=2),
        Step('A name, mistyped.', 'srnn demo --signal locl',
             r"'locl' \(did you mean 'local'\?\)", code=2),
        Step('An example without ROS.', 'python examples/learn_from_a_touch.py', '^after:'),
        Step('A scene of its own, from the tutorial.', written('mine.yaml')),
        Step('Ten trials of it with a point in place of the arm.',
             'srnn experiment run --scene mine.yaml --world point --trials 10 --json mine.json',
             'laps', limit_s=FIRST_RUN_S),
        Step('The same with the arm, recorded.',
             'srnn demo --scene mine.yaml --segments 60 --record run', LEARNED,
             limit_s=FIRST_RUN_S),
        Step('Every decision again.', 'srnn replay run', r'(?s)(: .*identical\n.*){3}'),
        Step('What was learned, and when.', 'srnn belief list run', r'^ +1 +\d+\.\d s '),
        Step('A page to send to somebody.', 'srnn report run', r'run\.html'),
        Step('A signal of its own: a copy of the example, with half the rate.',
             "sed 's/alpha = self/alpha = 0.5 * self/' examples/own_signal.py > my_signal.py"
             " && grep 'alpha = ' my_signal.py", r'alpha = 0\.5 \* self'),
        Step('Beside those of the paper.', 'python my_signal.py', '^DeniedSignal',
             limit_s=FIRST_RUN_S),
    ),
)  # fmt: skip


def alone(node: str, says: str) -> Step:
    """Return the step that runs a node alone; the name of the node is its executable's."""
    name = node.partition(' ')[2]
    return Step(f'`{name}` alone: what does it wait for?', f'ros2 run {node}', says, ctrl_c=True)


NO_SCENE = 'unconfigured: cannot be configured without scene; start it again with'

ROS2 = Walk(
    'ros2', 'with ROS 2', 'ROS 2 Jazzy, colcon and the dependencies', (
        Step('A shell with ROS 2.', f'source {ROS_SETUP}', kept=True),
        Step('A workspace.', 'mkdir -p ws/src && cd ws', kept=True),
        cloned('src/srnn'),
        Step('Build.', 'colcon build', r'^Summary: \d+ packages finished', limit_s=FIRST_RUN_S),
        Step('Use what was built.', 'source install/setup.bash', kept=True),
        alone('srnn_planner planner', NO_SCENE),
        alone('srnn_planner adapter', 'waiting for ros2 lifecycle set /adapter configure'),
        alone('lwr_tracking tracker', 'waiting for ros2 lifecycle set /tracker configure'),
        alone('lwr_sim_bridge sim_bridge', NO_SCENE),
        alone('lwr_sim_bridge mock_arm', NO_SCENE),
        alone('lwr_sim_bridge fri_emulator', NO_SCENE),
        alone('lwr_fri_driver fri_driver', 'waiting for ros2 lifecycle set /fri_driver configure'),
        Step('`view` alone: what does it need?', 'ros2 run srnn_view view', 'missing scene',
             code=1),
        Step('An impossible value.', 'ros2 launch srnn_bringup srnn.launch.py seed:=x',
             r"seed: 'x': must be a whole number", code=1),
        Step(
            'The demo scene, recorded from the first message on.',
            'ros2 launch srnn_bringup srnn.launch.py record:=run', r'(?s)(/\w+ is active.*){4}',
            limit_s=FIRST_RUN_S, ctrl_c=True, meanwhile=(
                Step('Which nodes are there, and does the tracker move the arm?',
                     'ros2 node list && ros2 lifecycle get /tracker', r'^active \[3\]$'),
                Step('Wait for the first lesson.',
                     'ros2 topic echo --once --field layout /weights', r'label: version=[1-9]'),
                Step('What does a threshold mean?',
                     'ros2 param describe /tracker tracking.contact.force',
                     r'Description: .* \[N\]'),
                Step('Does it still touch? Twelve segments in a row that end as planned.',
                     'ros2 topic echo --field message /segment_result', r'(^DONE\n---\n){12}',
                     code=None, limit_s=90.0, ctrl_c=True),
                Step('Bring the arm to rest.', 'ros2 lifecycle set /tracker deactivate',
                     'Transitioning successful'),
                Step('Let it go on.', 'ros2 lifecycle set /tracker activate',
                     'Transitioning successful'),
            ),
        ),
        Step('What was learned, and when.', 'ros2 run srnn_bringup srnn belief list run',
             r'^ +1 +\d+\.\d s '),
        Step('Every decision again.', 'ros2 run srnn_bringup srnn replay run',
             r'(?s)(: .*identical\n.*){3}'),
        Step('The fast tests of all packages.',
             "colcon test --pytest-args -m 'not slow' && colcon test-result",
             r'^Summary: \d+ tests, 0 errors, 0 failures', limit_s=900.0),
    ), 'ros2 daemon stop',
)  # fmt: skip

ARM = Walk(
    'arm', 'with another arm', 'Python, git and make, and a description of the arm', (
        cloned('srnn'),
        Step('Go there.', 'cd srnn', kept=True),
        Step('Set up.', 'make setup', 'Setting up', limit_s=FIRST_RUN_S),
        Step('`srnn` without a path from here on.', 'source .venv/bin/activate', kept=True),
        Step('The description that is nearer to the own arm, as a beginning.',
             'cp config/arms/ur5e.yaml my_arm.yaml'),
        Step('Another tool, and a plane at another height.',
             "sed -i 's/tool_mass: .*/tool_mass: 0.5/; s/plane_z: .*/plane_z: 0.25/' my_arm.yaml"
             " && grep -E 'tool_mass:|plane_z:' my_arm.yaml", r'tool_mass: 0\.5$'),
        Step('A key, mistyped.',
             "sed 's/tool_mass/tool_mas/' my_arm.yaml > wrong.yaml; "
             'srnn demo --arm-description wrong.yaml',
             r"unknown key 'tool_mas' \(did you mean 'tool_mass'\?\)", code=2),
        Step('One value too few.',
             "sed 's/velocity_max: .[0-9.]*, /velocity_max: [/' my_arm.yaml > wrong.yaml; "
             'srnn demo --arm-description wrong.yaml',
             r'velocity_max = .*: must be 6 values, one for each joint', code=2),
        Step('A body that the model does not have.',
             "sed 's/flange: .*/flange: wrist_4_link/' my_arm.yaml > wrong.yaml; "
             'srnn demo --arm-description wrong.yaml',
             r"flange = 'wrist_4_link': must be a body of .*wrist_3_link", code=2),
        Step('Does it learn the obstacle with this arm?',
             'srnn demo --arm-description my_arm.yaml', LEARNED, limit_s=400.0),
        Step('The part that thinks, for an arm behind `ros2_control`, which is not there yet.',
             'srnn up --only tracker,adapter,planner --arm-description my_arm.yaml',
             r'tracker: nobody publishes .*/joint_states', ctrl_c=True),
        Step('The same with a stand-in for the driver: plain messages, joints by alphabet.',
             'python -m pytest test/test_ros2_control.py', r'^=+ 1 passed', limit_s=FIRST_RUN_S),
    ),
)  # fmt: skip

WALKS = (LAPTOP, ROS2, ARM)
