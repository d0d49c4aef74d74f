"""Reads program text as a control would: text in, positions and machine state out.

Nothing here knows how programs are planned or posted; the proof rests on that.
"""

from mechwright_cam.controls.dialect import LINUXCNC, Dialect
from mechwright_cam.controls.dialects import DIALECTS
from mechwright_cam.controls.reading.read import interpret
from mechwright_cam.controls.reading.run import Kind, Remark, Run, State, joined

__all__ = ["DIALECTS", "LINUXCNC", "Dialect", "Kind", "Remark", "Run", "State", "interpret", "joined"]
