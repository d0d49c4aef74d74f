"""Tolerances of a design: the table ``[tolerances]``, the analysis of a build, its report and its page."""

from mechwright.pipeline.tolerances.asked import KEYS, ToleranceKeys, required_analysis
from mechwright.pipeline.tolerances.page import TolerancePage
from mechwright.pipeline.tolerances.report import as_data, as_text
from mechwright.pipeline.tolerances.table import TolerancesTable

__all__ = [
    "KEYS",
    "ToleranceKeys",
    "TolerancePage",
    "TolerancesTable",
    "as_data",
    "as_text",
    "required_analysis",
]
