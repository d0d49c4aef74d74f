"""The calibration coupon: its pieces, its sheet, and the fit of what is measured on it."""
