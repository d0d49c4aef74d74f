"""Pages can be read by everybody: contrast of the motion page, and what scrolls has a name and the keyboard."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
TEMPLATES = sorted(
    path for room in ("core", "cam", "plugins") for path in (ROOT / room).rglob("*.html") if path.is_file()
)
STYLE = (ROOT / "cam/mechwright_cad/animation/page.css").read_text(encoding="utf-8")


def brightness(colour):
    """Relative luminance of a colour #rrggbb (WCAG 2.2)."""
    parts = [int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5)]
    linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(one, two):
    low, high = sorted((brightness(one), brightness(two)))
    return (high + 0.05) / (low + 0.05)


def test_contrast_is_that_of_the_standard():
    assert contrast("#000000", "#ffffff") == pytest.approx(21)
    assert contrast("#777777", "#ffffff") == pytest.approx(4.48, abs=0.005)


@pytest.mark.parametrize("dark", [False, True])
def test_words_of_the_motion_page_stand_out_from_what_is_behind_them(dark):
    schemes = re.findall(r"(@media \(prefers-color-scheme: dark\) \{ )?:root \{([^}]*)\}", STYLE)
    (tokens,) = [found for media, found in schemes if bool(media) is dark and "--ink" in found][:1]
    colour = dict(re.findall(r"--(\w+): (#[0-9a-f]{6})", tokens))
    lines = [line for line in STYLE.splitlines() if ".c0 {" in line and line.startswith("@media") is dark]
    curves = re.findall(r"\.c\d \{ stroke: (#[0-9a-f]{6}); color: \1; \}", lines[0])
    assert len(curves) == 6
    for behind in ("back", "sheet"):
        for word in (*(colour[name] for name in ("ink", "soft", "accent")), *curves):
            assert contrast(word, colour[behind]) >= 4.5, f"{word} on {colour[behind]}"


@pytest.mark.parametrize("path", TEMPLATES, ids=lambda path: str(path.relative_to(ROOT)))
def test_what_scrolls_is_reached_by_the_keyboard_and_has_a_name(path):
    for tag in re.findall(r'<div class="(?:wide|whole)"[^>]*>', path.read_text(encoding="utf-8")):
        assert 'tabindex="0"' in tag, tag
        assert "aria-label=" in tag, tag
