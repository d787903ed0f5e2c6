# SPDX-License-Identifier: Apache-2.0
"""Instructions of the processor that numba has no name for."""

from typing import Any

from llvmlite import ir
from numba import types
from numba.extending import intrinsic


@intrinsic  # type: ignore[untyped-decorator]
def lowest_bit(typing_context: Any, word: Any) -> Any:
    """Return the index of the lowest bit that is set in a word of 64; not for 0."""

    def code(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return builder.cttz(arguments[0], ir.Constant(ir.IntType(1), 1))

    return types.int64(types.uint64), code


@intrinsic  # type: ignore[untyped-decorator]
def bits_of(typing_context: Any, number: Any) -> Any:
    """Return the bits of a number of 64 bits as a whole number."""

    def code(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return builder.bitcast(arguments[0], ir.IntType(64))

    return types.int64(types.float64), code


@intrinsic  # type: ignore[untyped-decorator]
def number_of(typing_context: Any, bits: Any) -> Any:
    """Return the number that has these bits."""

    def code(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return builder.bitcast(arguments[0], ir.DoubleType())

    return types.float64(types.int64), code


@intrinsic  # type: ignore[untyped-decorator]
def above(typing_context: Any, values: Any, index: Any, limit: Any) -> Any:
    """Return a word with a bit for each of 64 values, from an index on, that exceeds a limit."""
    lanes = ir.VectorType(ir.IntType(32), 64)

    def code(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        array = context.make_array(signature.args[0])(context, builder, arguments[0])
        place = builder.gep(array.data, [arguments[1]])
        loaded = builder.load(builder.bitcast(place, lanes.as_pointer()), align=4)
        first = builder.insert_element(
            ir.Constant(lanes, ir.Undefined), arguments[2], ir.Constant(ir.IntType(32), 0)
        )
        order = ir.Constant(lanes, [ir.Constant(ir.IntType(32), 0)] * 64)
        everywhere = builder.shuffle_vector(first, ir.Constant(lanes, ir.Undefined), order)
        exceeds = builder.icmp_signed('>', loaded, everywhere)
        return builder.bitcast(exceeds, ir.IntType(64))

    return types.uint64(values, types.int64, types.int32), code
