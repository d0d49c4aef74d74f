"""Machine code on disk: found again, and never another signature's, whoever else writes at the same time."""

import importlib.util
import sys
from collections.abc import Callable
from itertools import count
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from numba.core.caching import IndexDataCacheFile

_NUMBERS = count()


@pytest.fixture
def loaded(tmp_path: Path) -> Callable[[], ModuleType]:
    """Loads the same module anew, as another process would."""
    source = tmp_path / "kernel.py"
    source.write_text(
        "from mechwright.mechanics.compiled import compiled\n@compiled\ndef twice(x):\n    return x + x\n"
    )

    def load() -> ModuleType:
        name = f"kernel_{next(_NUMBERS)}"
        spec = importlib.util.spec_from_file_location(name, source)
        assert spec is not None
        assert spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        sys.modules[name] = module
        spec.loader.exec_module(module)
        return module

    return load


def test_code_of_two_signatures_that_are_compiled_at_once_is_kept_apart(loaded, monkeypatch) -> None:
    """Two processes read an empty index; the second one writes both of its files between those of the first."""
    first, second = loaded(), loaded()
    write, read, others = IndexDataCacheFile._save_data, IndexDataCacheFile._load_index, iter([second])

    def late(self, name, data):
        if other := next(others, None):
            monkeypatch.setattr(IndexDataCacheFile, "_load_index", lambda _: {})
            assert other.twice(np.arange(3.0)).tolist() == [0.0, 2.0, 4.0]
            monkeypatch.setattr(IndexDataCacheFile, "_load_index", read)
        write(self, name, data)

    monkeypatch.setattr(IndexDataCacheFile, "_save_data", late)
    assert first.twice(3) == 6
    assert next(others, None) is None
    monkeypatch.undo()
    for _ in range(2):
        again = loaded()
        assert again.twice(3) == 6
        assert again.twice(np.arange(3.0)).tolist() == [0.0, 2.0, 4.0]
    assert not again.twice.stats.cache_misses
    assert sum(again.twice.stats.cache_hits.values()) == 2
