"""The proof of a program: its text is read back, its kerf laid along its way, and what falls out compared.

It shares no code with those who plan and write: it knows the parts, the sheet, the kerf and the powers.
"""
