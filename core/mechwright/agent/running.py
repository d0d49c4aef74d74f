"""Commands of this program in processes of their own, with their answers as data."""

import json
import os
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from mechwright.worker_pool.lifeline import COMMAND

LONGEST = 1800.0
"""Seconds that a command may take."""

MOST = 200_000
"""Characters of an answer: the rest is in the files that a command writes."""

Answer = dict[str, Any]


def run(folder: Path, words: Sequence[str], seconds: float = LONGEST) -> Answer:
    """What a command says, run in a folder.

    The answer has ``ok``, whether it ended with 0; ``code``, how it ended; ``answer``, its standard output as
    data, or as a text where it is no JSON; ``said``, its lines on standard error. No shell reads the words.
    """
    process = subprocess.Popen(  # noqa: S603 - our own interpreter
        [sys.executable, "-P", "-c", COMMAND, str(os.getpid()), *words],
        cwd=folder,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        encoding="utf-8",
        errors="replace",
        env={**os.environ, "NO_COLOR": "1", "PYTHONIOENCODING": "utf-8"},
    )
    try:
        out, err = process.communicate(timeout=seconds)
    except subprocess.TimeoutExpired:
        process.kill()
        process.communicate()
        return {
            "ok": False,
            "code": None,
            "answer": None,
            "said": [f"{words[0]} took longer than {seconds:g} s and was ended"],
        }
    return {
        "ok": process.returncode == 0,
        "code": process.returncode,
        "answer": _data(out),
        "said": [line for line in err.splitlines() if line.strip()][-50:],
    }


def _data(text: str) -> Any:
    try:
        return json.loads(text)
    except ValueError:
        return text.strip()


def shortened(found: Answer) -> Answer:
    """An answer whose data are a text that ends with how much is left out, where they are long."""
    answer = found["answer"]
    text = answer if isinstance(answer, str) else json.dumps(answer)
    if len(text) <= MOST:
        return found
    return {**found, "answer": f"{text[:MOST]}\n... {len(text) - MOST} more characters"}
