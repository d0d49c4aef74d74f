"""A folder that somebody watches: gSender, LinuxCNC, cncjs, a stick that is carried to the machine."""

import os
from pathlib import Path

from mechwright.errors import OutputError
from mechwright.output.folder import write_new
from mechwright.reading import read_bytes, regular
from mechwright_cam.senders.certified import LARGEST, ProgramFile
from mechwright_cam.senders.contract import Target


class WatchedFolder(Target):
    """A folder on this computer or its network; raises OutputError where it is none or cannot be written."""

    def __init__(self, folder: Path) -> None:
        if not folder.is_dir():
            raise OutputError(f"--to: {folder}: is no folder; make it, or name the one that is watched")
        if not os.access(folder, os.W_OK | os.X_OK):
            raise OutputError(f"--to: {folder}: cannot be written; name a folder of yours")
        self._folder = folder

    def send(self, file: ProgramFile, *, replace: bool) -> str:
        """Write a file in one step, so that who watches never sees half of it."""
        path = self._folder / file.name
        if regular(path) and read_bytes(path, LARGEST, anew=True) == file.data:
            return f"{path}: is there already"
        write_new(path, file.data, replace=replace)
        return f"{path}: written"
