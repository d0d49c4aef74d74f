"""Programs before they are written for a control."""
