"""What is said of keys that were chosen."""

from mechwright.designs.settling import told


def test_numbers_texts_and_lists_are_said() -> None:
    finding = told({"parameters.shaft": 6.0, "parameters.frame": "base", "parameters.holes": [1, 2]})
    assert finding.message.endswith(': shaft = 6, frame = "base", holes = [1, 2]')
