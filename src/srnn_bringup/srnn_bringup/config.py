# SPDX-License-Identifier: Apache-2.0
"""The configuration of the whole graph, complete and checked before anything starts."""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TypeVar

from lwr_description import ArmDescription, MissingModelError, ModelError, arm_spec
from lwr_tracking.core.parameters import TrackerParameters
from srnn_access import Key, key_file
from srnn_bringup.choices import (
    ARM_DESCRIPTION,
    FRI,
    NETWORK,
    ROOT,
    SEED_MAX,
    SIMULATED,
    STANDARD_SCENE,
    Choices,
)
from srnn_bringup.config_files import ArmFile, FriFile, NetworkFile, TrackingFile
from srnn_bringup.config_lookup import config_directory, find_arm, find_network, find_scene
from srnn_bringup.errors import ChoiceError
from srnn_config import Parameters, build, parameter, read_yaml
from srnn_config.scene import Scene, load_scene
from srnn_planner.core import weights_file
from srnn_planner.core.parameters import LearningParameters
from srnn_planner.core.state_neurons import StateNeurons
from srnn_planner.core.synapses import Synapses

__all__ = [
    'ARM_DESCRIPTION',
    'FRI',
    'NETWORK',
    'ROOT',
    'SEED_MAX',
    'SIMULATED',
    'STANDARD_SCENE',
    'Choices',
    'Configuration',
    'load',
]

_CONSTANT_SIGNALS = ('constant', 'untriggered')

P = TypeVar('P', bound=Parameters)


@dataclass(frozen=True)
class Configuration(Parameters):
    """Everything that the nodes are told.

    Attributes:
        scene_path: absolute path of the scene file.
        scene: what is in it.
        network: content of network.yaml, with the choices of the command line.
        arm: content of the file that describes the arm.
        tracking: content of tracking.yaml.
        fri: content of fri.yaml.
        robot: name of the arm that is moved.
        emulated: whether its controller is emulated.
        initial_weights: absolute path of the weights to start from, None for the prior.
        weights_file: absolute path of the weights that are written, None for none.
        key_file: absolute path of the key that the nodes share, None for none.
        keystore: absolute path of the keystore that protects the graph, None for none.
        namespace: absolute ROS namespace of the nodes.
        remappings: names of topics and services, and what the nodes use instead.

    """

    scene_path: Path
    scene: Scene
    network: NetworkFile
    arm: ArmFile
    tracking: TrackingFile
    fri: FriFile
    robot: str = SIMULATED
    emulated: bool = False
    initial_weights: Path | None = None
    weights_file: Path | None = None
    key_file: Path | None = None
    keystore: Path | None = None
    namespace: str = ROOT
    remappings: tuple[tuple[str, str], ...] = ()
    seed: int = parameter(
        0, minimum=0, maximum=SEED_MAX, doc='Seed of all random numbers of the graph.'
    )

    def check(self) -> None:
        """Refuse values that are fine in their own file but impossible together."""
        limit = self.tracking.tracking.gate.speed_limit
        if self.scene.task.velocity > limit:
            raise self.refuse(
                'scene.velocity', self.scene.task.velocity,
                f'<= speed_limit = {limit:g} m/s of tracking.yaml',
            )
        dimensions = self.network.model.network.dimensions
        if dimensions != 2:
            raise self.refuse(
                'model.network.dimensions', dimensions, '2: scenes and the tracker are planar'
            )
        model = self.arm.mount.description.model
        if self.robot == FRI and self.arm.mount.description != ArmDescription():
            raise self.refuse(
                'arm.mount.description', model, f"the LWR 4+, unchanged: arm '{FRI}' is no other"
            )
        try:
            arm_spec(self.arm.mount)
        except (MissingModelError, ModelError) as error:
            raise type(error)(f'mount.description.{error}') from None

    @property
    def tracker(self) -> TrackerParameters:
        """What the tracker is told; over FRI it keeps the pace of the controller."""
        tracking = self.tracking.tracking
        if self.robot != FRI:
            return tracking
        period = self.fri.fri.link.cycle
        return replace(
            tracking,
            period=period,
            law=replace(tracking.law, lead=self.fri.lead),
            limits=replace(
                tracking.limits, max_step=max(tracking.limits.max_step, 2.0 * period)
            ),
        )

    @property
    def learning(self) -> LearningParameters:
        """What the adapter learns with."""
        return self.network.model.learning

    @property
    def alpha(self) -> float | None:
        """Rate of a constant learning signal; None for the signals that set their own."""
        return self.learning.rate if self.learning.signal in _CONSTANT_SIGNALS else None

    def start_weights(self) -> Synapses:
        """Return the weights that learning starts from.

        Raises:
            SrnnError: the weight file cannot be read or does not fit the network.

        """
        neurons = StateNeurons(self.network.model.network)
        if self.initial_weights is None:
            return Synapses(neurons.prior)
        return neurons.synapses(weights_file.load(self.initial_weights).learned)

    def key(self) -> Key | None:
        """Return the key that the nodes share, None if they have none.

        Raises:
            AccessError: the key file is missing, or not as it must be.

        """
        return None if self.key_file is None else key_file.load(self.key_file)


def load(choices: Choices, directory: Path | None = None) -> Configuration:
    """Read and check all that the graph needs.

    Args:
        choices: what the command line decides.
        directory: where the files are; None looks for them.

    Raises:
        ConfigError: a file cannot be read, a key is unknown or a value impossible.
        BringupError: there is no configuration, or the choices do not fit.
        SrnnError: the weight file does not fit.
        AccessError: the key file is missing, or not as it must be.

    """
    if choices.emulated and choices.arm != FRI:
        raise ChoiceError(f"arm '{choices.arm}' has no controller to emulate; it is for '{FRI}'")
    if choices.keystore is not None and choices.namespace != ROOT:
        raise ChoiceError(
            f"namespace '{choices.namespace}': a keystore gives rights in namespace '{ROOT}' alone"
        )
    directory = config_directory() if directory is None else directory
    scene_path = find_scene(choices.scene, directory)
    network_path = find_network(choices.network, directory)
    configuration = Configuration(
        scene_path=scene_path,
        scene=load_scene(scene_path),
        network=_with_choices(_read(NetworkFile, network_path), choices),
        arm=_read(ArmFile, find_arm(choices.description, directory)),
        tracking=_read(TrackingFile, directory / 'tracking.yaml'),
        fri=_read(FriFile, directory / 'fri.yaml'),
        robot=choices.arm,
        emulated=choices.emulated,
        initial_weights=_absolute(choices.initial_weights),
        weights_file=_absolute(choices.weights_file),
        key_file=_absolute(choices.key_file),
        keystore=_absolute(choices.keystore),
        namespace=choices.namespace,
        remappings=choices.remappings,
        seed=choices.seed,
    )
    _ = configuration.tracker
    configuration.start_weights()
    configuration.key()
    return configuration


def _read(cls: type[P], path: Path) -> P:
    return build(cls, read_yaml(path), str(path))


def _with_choices(network: NetworkFile, choices: Choices) -> NetworkFile:
    learning = network.model.learning
    if choices.signal is not None:
        learning = replace(learning, signal=choices.signal)
    if choices.alpha is not None:
        if learning.signal not in _CONSTANT_SIGNALS:
            raise ChoiceError(
                f"alpha = {choices.alpha:g} has no effect with signal '{learning.signal}'; "
                f'it is for {" and ".join(_CONSTANT_SIGNALS)}'
            )
        learning = replace(learning, rate=choices.alpha)
    return replace(network, model=replace(network.model, learning=learning))


def _absolute(path: Path | None) -> Path | None:
    return None if path is None else path.resolve()
