"""Printing with plastic filament: plates corrected for a printer, and the coupon that measures it."""
