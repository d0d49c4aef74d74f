"""The table ``[cut]``, and figures of processes, kerfs and materials."""
