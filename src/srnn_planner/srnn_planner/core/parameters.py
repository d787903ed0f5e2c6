# SPDX-License-Identifier: Apache-2.0
"""What a user may set of planning and learning, each with bounds, unit and meaning."""

from dataclasses import dataclass, field

from srnn_config import Parameters, parameter
from srnn_planner.core.workspace import Workspace


@dataclass(frozen=True)
class NetworkParameters(Parameters):
    """State neurons, their prior weights and their stochastic activation."""

    dimensions: int = parameter(
        2, minimum=1, maximum=3, doc='Dimensions of the planned space.'
    )
    neurons_per_dimension: int = parameter(
        15, minimum=3, maximum=101, doc='State neurons along each dimension of the grid.'
    )
    tau: int = parameter(
        10, unit='steps', minimum=1, maximum=100,
        doc='Refractory period and length of the rectangular postsynaptic potential.',
    )
    refractory: str = parameter(
        'absolute', choices=('absolute', 'linear'),
        doc='After a spike: silent for tau steps, or recovering linearly within them.',
    )
    sigma: float = parameter(
        0.11, unit='units', above=0.0, maximum=2.0,
        doc='Width of the Gaussian basis shared by weights, encoding and local signal.',
    )
    weight_gain: float = parameter(
        80.0, above=0.0, maximum=1e4,
        doc='Height of the Gaussian of the prior weights before clipping to [-1, 1].',
    )
    weight_offset: float = parameter(
        0.358, minimum=0.0, maximum=1.0,
        doc='Taken from every prior weight, so that distant neurons inhibit each other.',
    )
    slope: float = parameter(
        1.945, above=0.0, maximum=100.0, doc='beta of the activation exp(beta u - c).'
    )
    threshold: float = parameter(
        3.644, minimum=-50.0, maximum=50.0, doc='c of the activation exp(beta u - c).'
    )
    spike_probability_max: float = parameter(
        0.2, above=0.0, maximum=1.0, doc='Upper limit of the spike probability in one step.'
    )

    @property
    def neurons(self) -> int:
        """Number K of state neurons."""
        return int(self.neurons_per_dimension**self.dimensions)


@dataclass(frozen=True)
class ContextParameters(Parameters):
    """The population of context neurons around each way point."""

    neurons: int = parameter(
        10, minimum=1, maximum=1000, doc='Context neurons per way point.'
    )
    spread: float = parameter(
        0.05, unit='units', minimum=0.0, maximum=1.0,
        doc='Standard deviation of the context neurons around their way point.',
    )
    amplitude: float = parameter(
        4.326, above=0.0, maximum=1000.0,
        doc='Summed input of the whole population at its way point when all are active.',
    )
    scale: float = parameter(
        1.68, unit='units', above=0.0, maximum=100.0,
        doc='Scale a of the generalized error distribution exp(-(distance/a)^b).',
    )
    exponent: float = parameter(
        0.75, above=0.0, maximum=10.0, doc='Exponent b of the generalized error distribution.'
    )
    aversion: float = parameter(
        6.0, minimum=0.0, maximum=1000.0,
        doc='A step whose synapse has lost 1 counts as 1 + this many; 0: nothing is avoided.',
    )
    fatigue: float = parameter(
        8.0, minimum=0.0, maximum=1000.0,
        doc='A step from where the arm was before, on this way, counts as this many more a visit.',
    )
    spike_probability_start: float = parameter(
        0.5, minimum=0.0, maximum=1.0,
        doc='Probability that a context neuron spikes in the first step of a segment.',
    )
    spike_probability_end: float = parameter(
        0.5, minimum=0.0, maximum=1.0,
        doc='The same in the last step; linear in between.',
    )


@dataclass(frozen=True)
class ObstacleParameters(Parameters):
    """The context neurons of obstacles that the planner is told of."""

    strength: float = parameter(
        3.0, minimum=0.0, maximum=1000.0, doc='Inhibition of the neurons in an obstacle.'
    )
    margin: float = parameter(
        0.02, unit='m', minimum=0.0, maximum=1.0,
        doc='Neurons this close to an obstacle are inhibited as those in it.',
    )
    falloff: float = parameter(
        0.006, unit='m', above=0.0, maximum=1.0,
        doc='Width of the Gaussian by which the inhibition fades out beyond the margin.',
    )


@dataclass(frozen=True)
class SamplingParameters(Parameters):
    """How many movements are imagined, how long, and how they are read out."""

    samples: int = parameter(
        40, minimum=1, maximum=1000, doc='Movements sampled for one segment.'
    )
    steps: int = parameter(
        40, unit='steps', minimum=4, maximum=1000, doc='Length T of a sampled movement.'
    )
    decode_sigma: float = parameter(
        3.0, unit='steps', above=0.0, maximum=50.0,
        doc='Width of the Gaussian window that turns spikes into continuous activity.',
    )
    step_max: float = parameter(
        0.1, unit='units', above=0.0, maximum=2.0,
        doc='A sample that moves farther in one step has jumped and is not valid.',
    )
    valid_share: float = parameter(
        0.5, above=0.0, maximum=1.0,
        doc='Share of the samples that must be valid for a plan to be valid.',
    )


@dataclass(frozen=True)
class SelectionParameters(Parameters):
    """Which samples are averaged into the plan."""

    caution: float = parameter(
        0.6, unit='units', minimum=0.0, maximum=10.0,
        doc='best_mode: the worst blockage on a path counts as if it lasted for this long.',
    )
    rule: str = parameter(
        'best_mode', choices=('three_sigma', 'mode_seeking', 'best_mode'),
        doc="The paper's rule on directions, their densest mode, or the mode that costs least.",
    )
    majority: float = parameter(
        0.9, above=0.0, maximum=1.0,
        doc='three_sigma: share of the closest samples that judge a reference sample.',
    )
    mode_share: float = parameter(
        0.1, above=0.0, maximum=1.0,
        doc='mode_seeking, best_mode: share of the samples that forms the averaged mode.',
    )


@dataclass(frozen=True)
class TrajectoryParameters(Parameters):
    """From an averaged path in space to a segment in time."""

    blend_steps: float = parameter(
        4.0, unit='steps', above=0.0, maximum=50.0,
        doc='Decay constant of the offset between the start of the plan and the arm.',
    )
    retreat: float = parameter(
        0.018, unit='m', minimum=0.0, maximum=0.1,
        doc='After a contact, planning starts this far back on the executed path.',
    )
    acceleration: float = parameter(
        1.2, unit='m/s^2', above=0.0, maximum=3.0,
        doc='Acceleration used to start, to turn and to change speed.',
    )
    acceleration_max: float = parameter(
        2.8, unit='m/s^2', above=0.0, maximum=10.0,
        doc='Segments that would accelerate more are slowed down.',
    )
    edge_margin: float = parameter(
        0.006, unit='m', minimum=0.0, maximum=0.1,
        doc='Distance that segments keep from the edge of the workspace.',
    )
    duration_min: float = parameter(
        0.35, unit='s', above=0.0, maximum=10.0, doc='Shortest execution time of a segment.'
    )


@dataclass(frozen=True)
class ScheduleParameters(Parameters):
    """When the next segment is planned."""

    window: int = parameter(
        50, minimum=2, maximum=10000,
        doc='Number of past planning times in the running mean and deviation.',
    )
    initial: float = parameter(
        0.02, unit='s', above=0.0, maximum=5.0,
        doc='Planning time assumed before any was measured.',
    )
    margin: float = parameter(
        0.18, unit='s', minimum=0.0, maximum=5.0,
        doc='Added to mean + 3 sigma: transport, and the braking distance of the tracker.',
    )
    learning_wait: float = parameter(
        0.5, unit='s', minimum=0.0, maximum=10.0,
        doc='Longest wait for the adapter after a contact before planning goes on.',
    )


@dataclass(frozen=True)
class LearningParameters(Parameters):
    """Cognitive dissonance, spike encoding and mental replay."""

    signal: str = parameter(
        'local', choices=('none', 'global', 'local', 'constant', 'untriggered'),
        doc='Learning signal; constant learns at `rate` while the global trigger is on.',
    )
    rate: float = parameter(
        0.01, above=0.0, maximum=1.0, doc='alpha of the signals constant and untriggered.'
    )
    global_threshold: float = parameter(
        0.02, unit='units^2', minimum=0.0, maximum=4.0,
        doc='The global signal acts where it exceeds this.',
    )
    local_threshold: float = parameter(
        0.05, minimum=0.0, maximum=4.0, doc='The local signals act where they exceed this.'
    )
    limit: float = parameter(
        0.3, above=0.0, maximum=1.0, doc='Upper limit of any learning signal.'
    )
    local_scale: float = parameter(
        30.0, above=0.0, maximum=1000.0, doc='c of the local signals.'
    )
    horizon: float = parameter(
        0.15, unit='units', above=0.0, maximum=10.0,
        doc='What was planned farther than this from where the arm was stopped teaches nothing.',
    )
    replays: int = parameter(
        20, minimum=1, maximum=1000, doc='Pairs of spike encodings learned per experience.'
    )
    rate_scale: float = parameter(
        100.0, above=0.0, maximum=1e6, doc='Factor from responsibility to Poisson mean.'
    )
    rate_limit: float = parameter(
        10.0, above=0.0, maximum=1e3, doc='Upper limit of the Poisson mean.'
    )
    spike_count: int = parameter(
        4, minimum=1, maximum=100, doc='Poisson count from which a neuron spikes.'
    )


@dataclass(frozen=True)
class ModelParameters(Parameters):
    """What planner and adapter must agree on."""

    workspace: Workspace = field(default_factory=Workspace)
    network: NetworkParameters = field(default_factory=NetworkParameters)
    learning: LearningParameters = field(default_factory=LearningParameters)


@dataclass(frozen=True)
class PlanningParameters(Parameters):
    """What only the planner needs."""

    dead_after: int = parameter(
        10, unit='plans', minimum=2, maximum=1000,
        doc='After so many invalid plans in a row earlier weights are tried.',
    )
    context: ContextParameters = field(default_factory=ContextParameters)
    obstacles: ObstacleParameters = field(default_factory=ObstacleParameters)
    sampling: SamplingParameters = field(default_factory=SamplingParameters)
    selection: SelectionParameters = field(default_factory=SelectionParameters)
    trajectory: TrajectoryParameters = field(default_factory=TrajectoryParameters)
    schedule: ScheduleParameters = field(default_factory=ScheduleParameters)
