"""The part that is drawn for a printer, so that the printed one has the sizes of the design."""
