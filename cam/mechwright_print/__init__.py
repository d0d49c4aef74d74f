"""Printing with plastic filament: compensated plates on the bed, a coupon that measures a printer, rules and pages."""
