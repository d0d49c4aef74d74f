"""Files of a build: programs, proofs, the sheet of the operator, drawings and order sheet of a service."""
