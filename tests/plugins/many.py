"""Many designs at once, and each by itself."""

from unittest.mock import patch

import numpy as np

from mechwright.contracts import singly
from mechwright.contracts.evaluation import Batch, one_by_one
from mechwright.testing.evaluation import assert_same


class Many:
    """Batches of one family, and whether they have the answers that each of their designs has by itself."""

    def __init__(self, family, content=None):
        self.family, self.content = family, content or {}
        self.alone = 0
        """How many designs of the last batch were asked one by one."""

    def drawn(self, count, content, **ranges):
        """Designs whose parameters, those of tables with two underscores, are drawn from ranges or lists."""
        rng = np.random.default_rng(1)
        varied = {
            name.replace("__", "."): rng.choice(some, count)
            if isinstance(some, list)
            else rng.uniform(*some, count)
            for name, some in ranges.items()
        }
        return Batch(self.family.Params, {**self.content, **content}, varied)

    def same(self, batch, columns, stage):
        """The answers at once, held against those of each."""
        self.alone = 0
        with patch.object(singly, "one_by_one", self._counted):
            found = self.family.evaluate(batch, columns, stage)
        alone = one_by_one(self.family.judge, self.family.solve, batch, columns, stage, self.family.parts)
        assert_same(found, alone)
        return found

    def _counted(self, judge, solve, batch, columns, stage, parts, until):
        self.alone += len(batch)
        return one_by_one(judge, solve, batch, columns, stage, parts, until)
