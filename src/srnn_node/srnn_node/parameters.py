# SPDX-License-Identifier: Apache-2.0
"""ROS parameters out of parameter sets: one truth for names, bounds and meaning."""

from collections.abc import Iterator, Mapping
import dataclasses
import math
from typing import Any, TypeVar, get_args, get_origin, get_type_hints

from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor
from rclpy.node import Node
from rclpy.parameter import Parameter

from srnn_config import ParameterError, Parameters, ParameterSpec, build
from srnn_config.fields import is_required, spec_of

P = TypeVar('P', bound=Parameters)

_ROS_OWN = 'qos_overrides.'
_INT64 = (-(2**63), 2**63 - 1)
_EMPTY_LIST = {
    float: Parameter.Type.DOUBLE_ARRAY,
    int: Parameter.Type.INTEGER_ARRAY,
    str: Parameter.Type.STRING_ARRAY,
    bool: Parameter.Type.BOOL_ARRAY,
}


@dataclasses.dataclass(frozen=True)
class NoParameters(Parameters):
    """The parameter set of a node that has none."""


@dataclasses.dataclass(frozen=True)
class Leaf:
    """One scalar or list of a parameter set.

    Attributes:
        name: dotted path, for example ``network.sigma``.
        hint: its type.
        spec: its meaning and bounds.
        required: whether it has no default.

    """

    name: str
    hint: Any
    spec: ParameterSpec
    required: bool


def leaves(cls: type[Parameters], prefix: str = '') -> Iterator[Leaf]:
    """Yield every leaf of a parameter set, nested sets included."""
    hints = get_type_hints(cls)
    for field in dataclasses.fields(cls):  # type: ignore[arg-type]
        spec = spec_of(field)
        if spec is None:
            yield from leaves(hints[field.name], f'{prefix}{field.name}.')
        else:
            yield Leaf(prefix + field.name, hints[field.name], spec, is_required(field))


def declare_parameters(node: Node, cls: type[P]) -> P:
    """Build a parameter set from what the user gave the node, and declare every leaf.

    Command line and parameter files are read once, at start: the parameters are
    declared read-only.

    Raises:
        ConfigError: a name is unknown or a value impossible; names the valid ones.

    """
    known = {leaf.name: leaf for leaf in leaves(cls)}
    given = {
        name: parameter.value
        for name, parameter in node._parameter_overrides.items()
        if name in known or not (node.has_parameter(name) or name.startswith(_ROS_OWN))
    }
    where = node.get_name()
    parameters = build(cls, _nested(given, where), where)
    for leaf in known.values():
        if not node.has_parameter(leaf.name):
            value = _value(parameters, leaf)
            node.declare_parameter(leaf.name, value, _descriptor(leaf), ignore_override=True)
    return parameters


def _nested(given: Mapping[str, Any], where: str) -> dict[str, Any]:
    tree: dict[str, Any] = {}
    for name, value in given.items():
        *branches, leaf = name.split('.')
        inner = tree
        for branch in branches:
            inner = inner.setdefault(branch, {})
            if not isinstance(inner, dict):
                raise ParameterError(f'{where}.{name}: {branch} is a value and has no parts')
        inner[leaf] = value
    return tree


def _value(parameters: Parameters, leaf: Leaf) -> Any:
    value: Any = parameters
    for part in leaf.name.split('.'):
        value = getattr(value, part)
    if value == ():
        return _EMPTY_LIST[get_args(leaf.hint)[0]]
    return list(value) if isinstance(value, tuple) else value


def _descriptor(leaf: Leaf) -> ParameterDescriptor:
    spec = leaf.spec
    unit = f' [{spec.unit}]' if spec.unit else ''
    element = get_args(leaf.hint)[0] if get_origin(leaf.hint) is tuple else leaf.hint
    descriptor = ParameterDescriptor(
        description=spec.doc + unit, additional_constraints=spec.bounds(), read_only=True
    )
    if (spec.minimum, spec.maximum, spec.above) == (None, None, None):
        return descriptor
    if element is int:
        descriptor.integer_range = [_integer_range(spec)]
    elif element is float:
        descriptor.floating_point_range = [_floating_point_range(spec)]
    return descriptor


def _integer_range(spec: ParameterSpec) -> IntegerRange:
    low = _INT64[0] if spec.minimum is None else math.ceil(spec.minimum)
    if spec.above is not None:
        low = max(low, math.floor(spec.above) + 1)
    high = _INT64[1] if spec.maximum is None else math.floor(spec.maximum)
    return IntegerRange(from_value=low, to_value=high, step=1)


def _floating_point_range(spec: ParameterSpec) -> FloatingPointRange:
    low = -math.inf if spec.minimum is None else float(spec.minimum)
    if spec.above is not None:
        low = max(low, math.nextafter(spec.above, math.inf))
    high = math.inf if spec.maximum is None else float(spec.maximum)
    return FloatingPointRange(from_value=low, to_value=high, step=0.0)
