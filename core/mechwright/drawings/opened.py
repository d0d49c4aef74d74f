"""The bytes of a file as a document of ezdxf, which mends what can be mended. Imports ezdxf."""

import io
import logging
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from mechwright.errors import DesignError

if TYPE_CHECKING:
    from ezdxf.document import Drawing

LARGEST = 20_000_000
"""Bytes of a drawing: plates have some ten thousand; a file of this size has been read for a minute."""

_OTHERS = {
    b"AC10": "a DWG file; save it as DXF",
    b"AC1.": "a DWG file; save it as DXF",
    b"%PDF": "a PDF; export DXF from the program that drew it",
    b"<?xm": "an XML file, such as SVG; save it as DXF",
    b"<svg": "an SVG; save it as DXF",
    b"ISO-": "a STEP file; export a DXF of the face",
    b"soli": "an STL file; export a DXF of the face",
    b"PK\x03\x04": "a packed file; unpack it",
    b"\x89PNG": "a picture; draw it as DXF",
}
"""First bytes of files that are given by mistake."""


def opened(data: bytes) -> "Drawing":
    """The document; raises DesignError that says what the bytes are instead.

    What ezdxf can repair, it repairs. A file that ends too early is refused: what is missing may be half of
    the part.
    """
    from ezdxf import recover
    from ezdxf.document import Drawing
    from ezdxf.lldxf.tagger import binary_tags_loader

    if len(data) > LARGEST:
        raise DesignError(f"has {len(data):,} bytes, the limit is {LARGEST:,}; export the plate alone")
    for start, what in _OTHERS.items():
        if data.startswith(start):
            raise DesignError(f"is {what}")
    if not data.strip():
        raise DesignError("is empty; export it again")
    binary = data.startswith(b"AutoCAD Binary DXF")
    if not binary and not data.rstrip(b"\r\n\t \0\x1a").endswith(b"EOF"):
        raise DesignError("is no whole DXF drawing: it does not end with EOF; export it again")
    try:
        with _quiet():
            if binary:
                document = Drawing.load(binary_tags_loader(data))
                auditor = document.audit()
            else:
                document, auditor = recover.read(io.BytesIO(data))
    except Exception as error:  # whatever a broken file makes ezdxf raise
        reason = " ".join(f"{type(error).__name__}: {error}".split())[:200]
        raise DesignError(f"is no DXF drawing that can be read ({reason}); export it again") from error
    if auditor.errors:
        said = " ".join(str(auditor.errors[0].message).split())[:160]
        raise DesignError(f"is damaged: {said}; export it again")
    return document


@contextmanager
def _quiet() -> Iterator[None]:
    """Have ezdxf say nothing to the terminal: what matters is told in our own words."""
    logger = logging.getLogger("ezdxf")
    before = logger.level
    logger.setLevel(logging.CRITICAL + 1)
    try:
        yield
    finally:
        logger.setLevel(before)
