"""Reads program text as a control would: text in, positions and machine state out.

Nothing here knows how programs are planned or posted; the proof rests on that.
"""

from mechwright_cam.controls.dialect import Dialect
from mechwright_cam.controls.reading.read import interpret, interpret_files
from mechwright_cam.controls.reading.run import Kind, Remark, Run, State, joined

__all__ = ["Dialect", "Kind", "Remark", "Run", "State", "interpret", "interpret_files", "joined"]
