"""What speaks against cutting a part, or a sheet of parts."""
