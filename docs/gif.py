"""Animated pictures of few colours: GIF 89a."""

from collections.abc import Iterator, Sequence

import numpy as np

BITS = 4
"""Of a colour: the palette has 16 at most."""
LONGEST = 12
"""Bits of the longest code."""


def animation(frames: Sequence[np.ndarray], palette: Sequence[str], hundredths: int) -> bytes:
    """The file of frames (height, width) of places in a palette such as ``#1f6f8b``; it goes round for ever.

    Each frame stands for so many hundredths of a second.
    """
    height, width = frames[0].shape
    size = width.to_bytes(2, "little") + height.to_bytes(2, "little")
    colours = b"".join(bytes.fromhex(colour.removeprefix("#")) for colour in palette)
    table = colours + bytes(3 * 2**BITS - len(colours))
    out = b"GIF89a" + size + bytes((0x80 | (BITS - 1), 0, 0)) + table
    out += b"\x21\xff\x0bNETSCAPE2.0\x03\x01\x00\x00\x00"
    for frame in frames:
        out += b"\x21\xf9\x04\x00" + hundredths.to_bytes(2, "little") + b"\x00\x00"
        out += b"\x2c" + bytes(4) + size + b"\x00" + bytes((BITS,))
        data = _packed(codes(frame.ravel().tolist()))
        blocks = (data[start : start + 255] for start in range(0, len(data), 255))
        out += b"".join(bytes((len(block),)) + block for block in blocks) + b"\x00"
    return out + b"\x3b"


def codes(places: list[int]) -> Iterator[tuple[int, int]]:
    """The codes of LZW, each with its bits: the longest run that is known stands as one."""
    clear, end = 2**BITS, 2**BITS + 1
    known, bits = {(place,): place for place in range(clear)}, BITS + 1
    yield clear, bits
    run: tuple[int, ...] = ()
    for place in places:
        longer = (*run, place)
        if longer in known:
            run = longer
            continue
        yield known[run], bits
        known[longer] = len(known) + 2
        if known[longer] == 2**bits and bits < LONGEST:
            bits += 1
        elif known[longer] == 2**LONGEST - 1:
            yield clear, bits
            known, bits = {(one,): one for one in range(clear)}, BITS + 1
        run = (place,)
    yield known[run], bits
    yield end, bits


def _packed(codes: Iterator[tuple[int, int]]) -> bytes:
    """Codes one behind the other, the least bit first."""
    out, held, count = bytearray(), 0, 0
    for code, bits in codes:
        held |= code << count
        count += bits
        while count >= 8:
            out.append(held & 255)
            held >>= 8
            count -= 8
    return bytes(out) + bytes((held,) if count else ())
