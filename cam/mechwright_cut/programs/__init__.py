"""Programs for the controls of beams and wires."""
